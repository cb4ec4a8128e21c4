import { describe, expect, it } from "vitest";

import { cappedWasm } from "./capped-wasm";
import { bumpySphere, freshPackage, problemOf, readyPackage, wasmBytes } from "./support";

const hpr = await readyPackage();
const { PointCloud, hiddenPointRemoval } = hpr;

const sphere = bumpySphere(1, 500);
const farAway = [0, 0, 5];
const loose = (value: unknown) => value as never;
const newCloud = (positions: unknown, options?: unknown) => () => new PointCloud(loose(positions), loose(options));
const view = (viewpoint: unknown, options?: unknown) => () =>
  new PointCloud(sphere).visibleFrom(loose(viewpoint), loose(options));
const remove = (indices: unknown) => () => {
  new PointCloud(sphere).remove(loose(indices));
};

it("takes an option that is undefined as absent", () => {
  const plain = new PointCloud(sphere).visibleFrom(farAway);
  const undefinedOptions = { radius: undefined, exponent: undefined, inversion: undefined, looks: undefined };
  const cloud = new PointCloud(sphere, loose({ dimension: undefined, stride: undefined, nonFinite: undefined }));
  expect(cloud.visibleFrom(farAway, loose(undefinedOptions)).indices).toEqual(plain.indices);
  expect(cloud.visibleFrom(farAway, loose({ radius: undefined, exponent: 2 })).exponent).toBeCloseTo(2);
});

describe("messages of the core", () => {
  // tests/core/refusals.rs expects the same words of the crate.
  const worded: [message: string, call: () => unknown][] = [
    ["1 point(s) have a coordinate that is NaN or infinite, the first at index 1", newCloud([1, 2, 3, NaN, 5, 6])],
    ["the viewpoint must be finite, got 0, NaN, 5.5", view([0, NaN, 5.5])],
    ["radius must be finite and positive, got infinity", view(farAway, { radius: Infinity })],
    ["radius must be finite and positive, got -0", view(farAway, { radius: -0 })],
    [
      "radius 0.0000012 is smaller than the distance of the farthest point, 5",
      () => hiddenPointRemoval([3, 4, 0], [0, 0, 0], { radius: 1.2e-6 }),
    ],
    [
      "radius 1.2e-7 is smaller than the distance of the farthest point, 5",
      () => hiddenPointRemoval([3, 4, 0], [0, 0, 0], { radius: 1.2e-7 }),
    ],
    [
      "radius must be at most 8.98e307, got 1.5e308 (an exponent e makes it 5 * 10^e)",
      () => hiddenPointRemoval([3, 4, 0], [0, 0, 0], { radius: 1.5e308 }),
    ],
    ["the farthest distance (infinity) exceeds the range of f64", () => hiddenPointRemoval([1e200, 0, 0], [0, 0, 0])],
    ["exponent must be finite and at least 0, got -100000000000000000000", view(farAway, { exponent: -1e20 })],
    ["exponent must be finite and at least 0, got -1e21", view(farAway, { exponent: -1e21 })],
    ["index 500 is out of range for a cloud of length 500", remove([3, 500])],
  ];
  it.each(worded)("%s", async (message, call) => {
    expect((await problemOf(call)).message).toBe(message);
  });
});

describe("disposed", () => {
  it("is what Symbol.dispose does", async () => {
    const cloud = new PointCloud(sphere);
    cloud[Symbol.dispose]();
    expect((await problemOf(() => cloud.visibleFrom(farAway))).code).toBe("disposed");
  });
});

describe("too-large", () => {
  it("is answered where memory is refused, and the instance stays usable", async () => {
    const small = await freshPackage();
    small.initSync(cappedWasm(40));
    const kept = new small.PointCloud(sphere);
    const before = kept.visibleFrom(farAway).indices;
    for (const array of [new Float32Array(3e6), new Float64Array(3e6), new Array<number>(3e6).fill(1)]) {
      const problem = await problemOf(() => new small.PointCloud(array));
      expect(problem.code).toBe("too-large");
    }
    expect(kept.visibleFrom(farAway).indices).toEqual(before);
  });

  it("is answered by append and remove, which change nothing then", async () => {
    const small = await freshPackage();
    small.initSync(cappedWasm(60));
    const cloud = new small.PointCloud(sphere);
    const before = cloud.visibleFrom(farAway);
    const filler = new small.PointCloud(bumpySphere(2, 50_000));
    for (const change of [
      () => cloud.append(bumpySphere(3, 100_000)),
      () => cloud.append([...bumpySphere(3, 100_000)]),
      () => cloud.remove(new Uint32Array(1_000_000)),
    ]) {
      expect((await problemOf(change)).code).toBe("too-large");
      expect(cloud).toHaveLength(500);
      expect(cloud.visibleFrom(farAway)).toEqual(before);
    }
    filler.dispose();
    cloud.append(bumpySphere(3, 500));
    expect(cloud).toHaveLength(1000);
  });

  it("is answered by a view, too, and clouds of any size leave the instance usable", async () => {
    const small = await freshPackage();
    small.initSync(cappedWasm(40));
    const outcomes = new Set<string>();
    const points = bumpySphere(3, 100_000);
    for (let count = 1000; count < 100_000; count = Math.ceil(1.1 * count)) {
      let cloud: InstanceType<typeof PointCloud> | undefined;
      try {
        cloud = new small.PointCloud(points.subarray(0, 3 * count));
        cloud.visibleFrom(farAway, { exponent: 4 });
        outcomes.add("fits");
      } catch (error) {
        outcomes.add(`${cloud === undefined ? "cloud" : "view"}: ${(error as { code: string }).code}`);
      }
      cloud?.dispose();
    }
    expect([...outcomes].sort()).toEqual(["cloud: too-large", "fits", "view: too-large"]);
    expect(new small.PointCloud(sphere).visibleFrom(farAway).count).toBeGreaterThan(0);
  });
});

describe("load", () => {
  it("names what could not be loaded, and a later init() may succeed", async () => {
    const fresh = await freshPackage();
    const missing = await problemOf(() => fresh.init("/nowhere/hpr.wasm"));
    expect(missing.code).toBe("load");
    expect(missing.message).toContain("/nowhere/hpr.wasm");
    expect(missing.message).toContain("init()");
    expect(missing.cause).toMatchObject({ code: "ENOENT" });
    await fresh.init(wasmBytes());
    expect(new fresh.PointCloud(sphere)).toHaveLength(500);
  });
});
