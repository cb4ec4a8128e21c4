import { runInNewContext } from "node:vm";
import { setFlagsFromString } from "node:v8";
import { describe, expect, it } from "vitest";

import { cappedWasm } from "./capped-wasm";
import { bumpySphere, bunny, freshPackage, randomNumbers, readyPackage } from "./support";

const { PointCloud, hiddenPointRemoval } = await readyPackage();

const sphere = bumpySphere(1, 2000);
/** The largest distance of a point from 0, 0, 5. */
const farthestFrom = (positions: Float32Array) =>
  Math.max(
    ...Array.from(positions, (x, i) => (i % 3 > 0 ? 0 : Math.hypot(x, positions[i + 1]!, positions[i + 2]! - 5))),
  );

describe("an answer", () => {
  const cloud = new PointCloud(sphere);
  const visible = cloud.visibleFrom([0, 0, 5]);

  it("says how the points were flipped", () => {
    const farthest = farthestFrom(sphere);
    expect(visible.inversion).toBe("spherical");
    expect(visible.evaluations).toBe(0);
    expect(visible.radius).toBeGreaterThanOrEqual(farthest);
    expect(visible.exponent).toBeCloseTo(Math.log10(visible.radius / farthest), 10);
    expect(cloud.autoRadius([0, 0, 5])).toEqual({
      radius: visible.radius,
      exponent: visible.exponent,
      evaluations: 0,
    });
    expect(cloud.autoRadius([0, 0, 5], "auto").radius).toBe(visible.radius);

    const chosen = cloud.visibleFrom([0, 0, 5], { exponent: 2 });
    expect(chosen.radius).toBeCloseTo(100 * farthest, 8);
    const given = cloud.visibleFrom([0, 0, 5], { radius: chosen.radius });
    expect(given.radius).toBe(chosen.radius);
    expect(given.indices).toEqual(chosen.indices);
    expect(cloud.visibleFrom([0, 0, 5], { radius: "auto", inversion: "spherical" }).indices).toEqual(visible.indices);
  });

  it("has a mask that says the same", () => {
    const mask = visible.mask();
    expect(mask).toBeInstanceOf(Uint8Array);
    expect(mask).toHaveLength(cloud.length);
    expect([...mask.keys()].filter((i) => mask[i] === 1)).toEqual([...visible.indices]);
    expect(mask.every((byte) => byte === 0 || byte === 1)).toBe(true);
  });

  it("is the caller's own copy, through other queries, growing memory and disposal", () => {
    const mortal = new PointCloud(sphere);
    const kept = mortal.visibleFrom([0, 0, 5]);
    const before = [...kept.indices];
    expect(kept.indices.byteLength).toBe(kept.indices.buffer.byteLength);
    mortal.visibleFrom([5, 0, 0]).indices.fill(0);
    new PointCloud(bumpySphere(2, 400_000)).dispose();
    mortal.dispose();
    expect([...kept.indices]).toEqual(before);
    expect(kept.mask().reduce((sum, byte) => sum + byte, 0)).toBe(before.length);
  });

  it("stays as it is when its cloud changes", () => {
    const cloud = new PointCloud(sphere);
    const before = cloud.visibleFrom([0, 0, 5]);
    const copy = [...before.indices];
    cloud.append(sphere);
    cloud.remove(before.indices);
    expect([...before.indices]).toEqual(copy);
    expect(before.mask()).toHaveLength(2000);
  });

  it("is empty for an empty cloud", () => {
    for (const nothing of [[], new Float32Array(0), new Float64Array(0)]) {
      const none = new PointCloud(nothing);
      expect(none.length).toBe(0);
      expect(none.visibleFrom([0, 0, 5])).toMatchObject({ count: 0, radius: 0, exponent: 0 });
      expect(none.visibleFrom([0, 0, 5]).mask()).toHaveLength(0);
      for (const rule of ["auto", "opposite"] as const) {
        expect(none.autoRadius([0, 0, 5], rule)).toEqual({ radius: 0, exponent: 0, evaluations: 0 });
      }
    }
  });
});

describe("positions", () => {
  it("are copied: what is written later changes nothing", () => {
    const own = sphere.slice();
    const cloud = new PointCloud(own);
    const before = cloud.visibleFrom([0, 0, 5]).indices;
    own.fill(0);
    expect(cloud.visibleFrom([0, 0, 5]).indices).toEqual(before);
  });

  it("of an array keep double precision", () => {
    // In single precision all three would be equal, hence all visible.
    const behindOneAnother = [0, 0, 1, 0, 0, 1 + 2 ** -40, 0, 0, 1 + 2 ** -39];
    expect([...hiddenPointRemoval(behindOneAnother, [0, 0, 5], { exponent: 3 }).indices]).toEqual([2]);
    const rounded = Float32Array.from(behindOneAnother);
    expect([...hiddenPointRemoval(rounded, [0, 0, 5], { exponent: 3 }).indices]).toEqual([0, 1, 2]);
  });
});

describe("an inversion", () => {
  const cloud = new PointCloud(sphere);
  const farAway = [0, 0, 5];

  it("by a power tells itself and its unit, which fixes the rounding only", () => {
    const visible = cloud.visibleFrom(farAway, { inversion: { power: 2.5 } });
    expect(visible).toMatchObject({ inversion: { power: 2.5 }, exponent: 0, evaluations: 0 });
    expect(visible.radius).toBeCloseTo(farthestFrom(sphere), 12);
    const scaled = cloud.visibleFrom(farAway, { radius: 64 * visible.radius, inversion: { power: 2.5 } });
    expect(scaled.radius).toBe(64 * visible.radius);
    expect(scaled.indices).toEqual(visible.indices);
  });

  it("by an exponential tells its scale, which is 0.07 spacings by itself", () => {
    const visible = cloud.visibleFrom(farAway, { inversion: { exponential: "auto" } });
    expect(visible).toMatchObject({ radius: 0, exponent: 0, evaluations: 0 });
    const { exponential } = visible.inversion as { exponential: number };
    expect(exponential).toBe(0.07 * cloud.spacing);
    expect(cloud.visibleFrom([0.1, -3, 1], { inversion: { exponential: "auto" } }).inversion).toEqual({ exponential });
    const given = cloud.visibleFrom(farAway, { inversion: { exponential } });
    expect(given).toEqual(visible);
  });
});

describe("the spacing", () => {
  it("does not count points twice", () => {
    expect(new PointCloud([...sphere, ...sphere, NaN, 0, 0], { nonFinite: "skip" }).spacing).toBe(
      new PointCloud(sphere).spacing,
    );
    expect([new PointCloud([]).spacing, new PointCloud([1, 2, 3, 1, 2, 3]).spacing]).toEqual([0, 0]);
  });
});

describe("memory", () => {
  // Room for a few clouds of this size at once.
  const pages = 120;
  const points = bumpySphere(9, 20_000);

  it("comes back from clouds that nothing refers to any more", async () => {
    setFlagsFromString("--expose-gc");
    const collectGarbage = runInNewContext("gc") as () => void;
    const small = await freshPackage();
    small.initSync(cappedWasm(pages));
    for (let i = 0; i < 30; i++) {
      new small.PointCloud(points);
      collectGarbage();
      await new Promise((next) => setTimeout(next));
    }
    const hoard: unknown[] = [];
    const fill = () => {
      for (let i = 0; i < 30; i++) hoard.push(new small.PointCloud(points));
    };
    expect(fill).toThrow(expect.objectContaining({ code: "too-large" }));
  });
});

describe("a cloud in the plane", () => {
  it("is a cloud in space with z = 0, to the bit", () => {
    const random = randomNumbers(4);
    const flat = Float32Array.from({ length: 600 }, () => random());
    const lifted = Float32Array.from({ length: 900 }, (_, i) =>
      i % 3 === 2 ? 0 : flat[2 * Math.floor(i / 3) + (i % 3)]!,
    );
    const [plane, space] = [new PointCloud(flat, { dimension: 2 }), new PointCloud(lifted)];
    const from = [0.5, 2];
    for (const options of [
      {},
      { radius: "opposite" },
      { inversion: { power: 2 } },
      { inversion: { exponential: "auto" } },
    ] as const) {
      expect(plane.visibleFrom(from, options)).toEqual(space.visibleFrom([...from, 0], options));
    }
    const [several, lifts] = [
      [from, [3, 0]],
      [
        [0.5, 2, 0],
        [3, 0, 0],
      ],
    ];
    expect(plane.visibleFromAny(several)).toEqual(space.visibleFromAny(lifts));
    expect(plane.visibleFromAtLeast(2, several)).toEqual(space.visibleFromAtLeast(2, lifts));
    expect(plane.autoRadius(from, "opposite")).toEqual(space.autoRadius([...from, 0], "opposite"));
    expect(hiddenPointRemoval(flat, from, { dimension: 2 })).toEqual(plane.visibleFrom(from));
  });
});

it("a reconstruction also gives the visible points", () => {
  const cloud = new PointCloud(bunny());
  const whole = cloud.reconstruct([0, 5, 20]);
  const { indices, count, radius, exponent } = cloud.visibleFrom([0, 5, 20]);
  expect(whole).toMatchObject({ indices, count, radius, exponent, evaluations: 0, inversion: "spherical" });
  expect(whole.mask().reduce((sum, byte) => sum + byte, 0)).toBe(count);
  expect(whole.triangles).toBeInstanceOf(Uint32Array);
  expect(whole.triangles.buffer.byteLength).toBe(whole.triangles.byteLength);
  expect(cloud.illuminate([[0, 5, 20]])).toBeInstanceOf(Float32Array);
});
