import { runInNewContext } from "node:vm";
import { setFlagsFromString } from "node:v8";
import { describe, expect, it } from "vitest";

import { cappedWasm } from "./capped-wasm";
import { bumpySphere, freshPackage, readyPackage } from "./support";

const { PointCloud, hiddenPointRemoval } = await readyPackage();

const sphere = bumpySphere(1, 2000);
const viewpoints = [
  [0, 0, 5],
  [3, -2, 1],
  [0.1, 0.2, -0.1],
  [-40, 7, 1000],
];

describe("an answer", () => {
  const cloud = new PointCloud(sphere);
  const visible = cloud.visibleFrom([0, 0, 5]);

  it("says how the points were flipped", () => {
    const farthest = Math.max(
      ...Array.from({ length: 2000 }, (_, i) => Math.hypot(sphere[3 * i]!, sphere[3 * i + 1]!, sphere[3 * i + 2]! - 5)),
    );
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

  it("is the same in one call", () => {
    for (const viewpoint of viewpoints) {
      const once = hiddenPointRemoval(sphere, viewpoint, { exponent: 2 });
      expect(once).toEqual(cloud.visibleFrom(viewpoint, { exponent: 2 }));
      expect(once.mask()).toEqual(cloud.visibleFrom(viewpoint, { exponent: 2 }).mask());
    }
    expect(hiddenPointRemoval([1, 2, NaN, 0, 0, 1], [0, 0, 5], { nonFinite: "skip" }).indices).toEqual(
      Uint32Array.of(1),
    );
  });

  it("is empty for an empty cloud", () => {
    for (const nothing of [[], new Float32Array(0), new Float64Array(0)]) {
      const none = new PointCloud(nothing);
      expect(none.length).toBe(0);
      expect(none.visibleFrom([0, 0, 5])).toMatchObject({ count: 0, radius: 0, exponent: 0 });
      expect(none.visibleFrom([0, 0, 5]).mask()).toHaveLength(0);
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

describe("the spacing", () => {
  it("is the one that the automatic scale is a part of", () => {
    const cloud = new PointCloud([...sphere, ...sphere, NaN, 0, 0], { nonFinite: "skip" });
    const { inversion } = cloud.visibleFrom([0, 0, 5], { inversion: { exponential: "auto" } });
    expect(inversion).toEqual({ exponential: 0.07 * cloud.spacing });
    expect(new PointCloud(sphere).spacing).toBe(cloud.spacing);
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
