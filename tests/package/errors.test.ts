import { describe, expect, it } from "vitest";

import { cappedWasm } from "./capped-wasm";
import { bumpySphere, expectRefusal, freshPackage, problemOf, readyPackage, type Refusal, wasmBytes } from "./support";

const hpr = await readyPackage();
const { PointCloud, hiddenPointRemoval } = hpr;

const sphere = bumpySphere(1, 500);
const farAway = [0, 0, 5];
const loose = (value: unknown) => value as never;
const newCloud = (positions: unknown, options?: unknown) => () => new PointCloud(loose(positions), loose(options));
const view = (viewpoint: unknown, options?: unknown) => () =>
  new PointCloud(sphere).visibleFrom(loose(viewpoint), loose(options));
const autoRadius = (viewpoint: unknown, rule?: unknown) => () =>
  new PointCloud(sphere).autoRadius(loose(viewpoint), loose(rule));
const append = (positions: unknown, options?: unknown) => () => {
  new PointCloud(loose(sphere.subarray(0, 120)), loose(options)).append(loose(positions));
};
const remove = (indices: unknown) => () => {
  new PointCloud(sphere).remove(loose(indices));
};

/** A code, a pattern for the message, and a call that is refused with them. */
const refusals: Refusal[] = [
  ["positions-length", /got 4\b.*multiple of 3/, newCloud([1, 2, 3, 4])],
  ["positions-length", /got 2\b/, newCloud(new Float32Array(2))],
  ["positions-length", /got 9\b.*multiple of 4/, newCloud(new Float64Array(9), { stride: 4 })],

  ["positions-length", /got 4\b.*multiple of 3/, append([1, 2, 3, 4])],
  ["positions-length", /got 6\b.*multiple of 4/, append(new Float32Array(6), { stride: 4 })],

  ["positions-type", /undefined/, newCloud(undefined)],
  ["positions-type", /null/, newCloud(null)],
  ["positions-type", /"1, 2, 3"/, newCloud("1, 2, 3")],
  ["positions-type", /function/, newCloud(() => 0)],
  ["positions-type", /Object/, newCloud({})],
  ["positions-type", /Object/, newCloud({ length: -3 })],
  ["positions-type", /BigInt64Array/, newCloud(new BigInt64Array(3))],
  ["positions-type", /DataView/, newCloud(new DataView(new ArrayBuffer(24)))],
  ["positions-type", /ArrayBuffer/, newCloud(new ArrayBuffer(24))],
  ["positions-type", /positions\[1\].*"2"/, newCloud([1, "2", 3])],
  ["positions-type", /positions\[2\].*undefined/, newCloud([1, 2, , 4, 5, 6])],
  ["positions-type", /positions\[0\].*Array/, newCloud([[1, 2, 3]])],
  ["positions-type", /positions\[0\].*5n/, newCloud([5n, 5n, 5n])],
  ["positions-length", /got 4\b/, append(new Int32Array(4))],
  ["positions-type", /BigUint64Array/, append(new BigUint64Array(3))],
  ["positions-type", /undefined/, append(undefined)],

  ["non-finite", /\b1 point.*index 1\b/, newCloud([1, 2, 3, NaN, 5, 6])],
  ["non-finite", /\b2 point.*index 0\b/, newCloud(new Float32Array([Infinity, 2, 3, 1, 2, 3, 4, 5, -Infinity]))],
  ["non-finite", /\b1 point.*index 1\b/, append([1, 2, 3, NaN, 5, 6])],

  ["viewpoint", /undefined/, view(undefined)],
  ["viewpoint", /null/, view(null)],
  ["viewpoint", /2 of them/, view([1, 2])],
  ["viewpoint", /4 of them/, view([1, 2, 3, 4])],
  ["viewpoint", /"1"/, view(["1", 2, 3])],
  ["viewpoint", /5n/, view(new BigInt64Array([5n, 5n, 5n]))],
  ["viewpoint", /NaN/, view([0, NaN, 5])],
  ["viewpoint", /inf/i, view([0, 0, Infinity])],
  ["viewpoint", /"abc"/, autoRadius("abc")],
  ["viewpoint", /NaN/, autoRadius([NaN, 0, 0])],

  ["radius", /NaN/, view(farAway, { radius: NaN })],
  ["radius", /inf/i, view(farAway, { radius: Infinity })],
  ["radius", /\b0\b/, view(farAway, { radius: 0 })],
  ["radius", /-7/, view(farAway, { radius: -7 })],
  ["radius", /\b5\.5\b.*farthest/, view(farAway, { radius: 5.5 })],
  ["radius", /range/, view([0, 0, 1e200], { radius: 1e300 })],
  ["radius", /at most 8.98e307/, view(farAway, { radius: 1.5e308 })],

  ["option", /dimension.*1/, newCloud(sphere, { dimension: 1 })],
  ["option", /dimension.*65/, newCloud(sphere, { dimension: 65 })],
  ["option", /dimension.*2\.5/, newCloud(sphere, { dimension: 2.5 })],
  ["option", /dimension.*"3"/, newCloud(sphere, { dimension: "3" })],
  ["option", /stride.*2/, newCloud(sphere, { stride: 2 })],
  ["option", /stride.*3\.5/, newCloud(sphere, { stride: 3.5 })],
  ["option", /stride.*"3"/, newCloud(sphere, { stride: "3" })],
  ["option", /nonFinite.*"ignore"/, newCloud(sphere, { nonFinite: "ignore" })],
  ["option", /"strid"/, newCloud(sphere, { strid: 4 })],
  ["option", /object.*null/, newCloud(sphere, null)],
  ["option", /object.*3/, newCloud(sphere, 3)],
  ["option", /radius and exponent/, view(farAway, { radius: 10, exponent: 2 })],
  ["option", /radius and exponent/, view(farAway, { radius: "auto", exponent: 2 })],
  ["option", /radius.*"best"/, view(farAway, { radius: "best" })],
  ["option", /radius.*null/, view(farAway, { radius: null })],
  ["option", /exponent.*"3"/, view(farAway, { exponent: "3" })],
  ["option", /exponent.*-1/, view(farAway, { exponent: -1 })],
  ["option", /exponent.*NaN/, view(farAway, { exponent: NaN })],
  ["option", /inversion.*"cubic"/, view(farAway, { inversion: "cubic" })],
  ["option", /inversion.*null/, view(farAway, { inversion: null })],
  ["option", /inversion.*"gamma"/, view(farAway, { inversion: { gamma: 2 } })],
  ["option", /inversion.*power and exponential/, view(farAway, { inversion: {} })],
  ["option", /inversion.*power and exponential/, view(farAway, { inversion: { power: 2, exponential: 1 } })],
  ["option", /inversion power.*"auto"/, view(farAway, { inversion: { power: "auto" } })],
  ["option", /inversion power.*\b1$/, view(farAway, { inversion: { power: 1 } })],
  ["option", /inversion power.*16\.5/, view(farAway, { inversion: { power: 16.5 } })],
  ["option", /inversion power.*NaN/, view(farAway, { inversion: { power: NaN } })],
  ["option", /inversion exponential.*"far"/, view(farAway, { inversion: { exponential: "far" } })],
  ["option", /inversion exponential.*\b0$/, view(farAway, { inversion: { exponential: 0 } })],
  ["option", /inversion exponential.*infinity/, view(farAway, { inversion: { exponential: Infinity } })],
  ["option", /exponent.*inversion power/, view(farAway, { exponent: 2, inversion: { power: 2 } })],
  ["option", /radius.*"opposite".*inversion power/, view(farAway, { radius: "opposite", inversion: { power: 2 } })],
  [
    "option",
    /radius.*"opposite".*exponential/,
    view(farAway, { radius: "opposite", inversion: { exponential: "auto" } }),
  ],
  ["option", /exponent.*inversion exponential/, view(farAway, { exponent: 2, inversion: { exponential: 1 } })],
  ["option", /radius.*inversion exponential/, view(farAway, { radius: 100, inversion: { exponential: 1 } })],
  ["radius", /farthest/, view(farAway, { radius: 1, inversion: { power: 2 } })],
  ["option", /"latest"/, view(farAway, { latest: true })],
  ["option", /rule.*"best"/, autoRadius(farAway, "best")],
  ["option", /rule.*\b7$/, autoRadius(farAway, 7)],
  ["option", /index 500\b.*length 500/, remove([3, 500])],
  ["option", /indices\[1\].*-1/, remove([3, -1])],
  ["option", /indices\[0\].*1\.5/, remove([1.5])],
  ["option", /indices\[0\].*NaN/, remove(new Float64Array([NaN]))],
  ["option", /indices\[0\].*4294967296/, remove([2 ** 32])],
  ["option", /indices\[0\].*"1"/, remove(["1"])],
  ["option", /indices\[0\].*1n/, remove(new BigInt64Array([1n]))],
  ["option", /indices\[1\].*undefined/, remove([1, , 2])],
  ["option", /undefined/, remove(undefined)],
  ["option", /got 7/, remove(7)],
  ["option", /"12"/, remove("12")],
  ["option", /"foo"/, () => hiddenPointRemoval(sphere, farAway, loose({ foo: 1 }))],
  // These options are gone.
  ...["draft", "sample", "denoise", "vote"].map((name): (typeof refusals)[number] => [
    "option",
    new RegExp(`unknown option "${name}"`),
    view(farAway, { [name]: 5 }),
  ]),
  ["option", /radius must be.*"search"/, view(farAway, { radius: "search" })],
];

describe("what is refused", () => {
  it.each(refusals)("%s, naming %s: case %#", expectRefusal);

  it("goes on working after every refusal", () =>
    expect(new PointCloud(sphere).visibleFrom(farAway).count).toBeGreaterThan(0));

  it("takes an option that is undefined as absent", () => {
    const plain = new PointCloud(sphere).visibleFrom(farAway);
    const undefinedOptions = { radius: undefined, exponent: undefined, inversion: undefined, looks: undefined };
    const cloud = new PointCloud(sphere, loose({ dimension: undefined, stride: undefined, nonFinite: undefined }));
    expect(cloud.visibleFrom(farAway, loose(undefinedOptions)).indices).toEqual(plain.indices);
    expect(cloud.visibleFrom(farAway, loose({ radius: undefined, exponent: 2 })).exponent).toBeCloseTo(2);
  });
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
