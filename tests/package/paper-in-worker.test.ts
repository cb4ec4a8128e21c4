// A worker gives the same answers as the synchronous cloud, to every question.
import { describe, expect, it } from "vitest";

import { bumpySphere, problemOf, readyPackage } from "./support";

const { PointCloud, WorkerPointCloud, HprError } = await readyPackage();

const sphere = bumpySphere(1, 2500);
const viewpoint = [0.5, -1, 5];
const viewpoints = [viewpoint, Float32Array.of(4, 0, 1), [0.1, 0, 0.2]];
const triangles = Uint32Array.of(0, 1, 2, 2, 1, 3);

type Method =
  | "visibleFrom"
  | "visibleFromDirection"
  | "visibleFromAny"
  | "visibleFromAtLeast"
  | "autoRadius"
  | "reconstruct"
  | "illuminate";
/** The methods of both clouds. Each call gives a value, or a promise of it. */
type Cloud = { [M in Method]: (...args: never[]) => unknown };
type Call = [method: Method, ...args: unknown[]];
const ask = (cloud: Cloud, [method, ...args]: Call): unknown =>
  (cloud[method] as (...args: unknown[]) => unknown).apply(cloud, args);

const calls: Call[] = [
  ["visibleFrom", viewpoint, { radius: "search" }],
  ["visibleFrom", viewpoint, { radius: "opposite" }],
  ["visibleFrom", viewpoint, { inversion: { power: 2 } }],
  ["visibleFrom", viewpoint, { inversion: { power: 2 }, radius: 90 }],
  ["visibleFrom", viewpoint, { inversion: { exponential: "auto" } }],
  ["visibleFrom", viewpoint, { inversion: { exponential: 0.01 } }],
  ["visibleFrom", viewpoint, { denoise: 8, vote: 5 }],
  ["visibleFromDirection", [0, 1, -2]],
  ["visibleFromDirection", [0, 1, -2], { inversion: { exponential: "auto" }, vote: 4 }],
  ["visibleFromAny", viewpoints, { exponent: 3 }],
  ["visibleFromAny", []],
  ["visibleFromAtLeast", 2, viewpoints],
  ["autoRadius", viewpoint, "auto"],
  ["autoRadius", viewpoint, "search"],
  ["autoRadius", viewpoint, "opposite"],
  ["reconstruct", viewpoint],
  ["reconstruct", viewpoint, { maxEdge: Infinity, exponent: 2.5 }],
  ["illuminate", viewpoints],
  ["illuminate", viewpoints, { triangles, smoothing: 3, ambient: 0.1, inversion: { power: 1.5 } }],
  ["illuminate", []],
];

describe.each([1, 3])("with %d workers", (workers) => {
  it("answers equal the synchronous cloud's, also after it has changed", async () => {
    const direct = new PointCloud(sphere);
    const cloud = await WorkerPointCloud.create(sphere, { workers });
    for (const round of ["as built", "changed"]) {
      const answers = await Promise.all(calls.map((call) => ask(cloud, call)));
      calls.forEach((call, i) => {
        expect(answers[i], `${round}: ${call[0]}`).toEqual(ask(direct, call));
      });
      const [more, gone] = [bumpySphere(2, 100), [5, 17, 2501]];
      direct.append(more);
      direct.remove(gone);
      await Promise.all([cloud.append(more), cloud.remove(gone)]);
    }
    // The arguments still belong to the caller.
    expect(triangles).toHaveLength(6);
    await cloud.dispose();
  });

  it.each([2, 4])("answers of clouds of %d dimensions do, too", async (dimension) => {
    const positions = sphere.slice(0, 480);
    const direct = new PointCloud(positions, { dimension });
    const cloud = await WorkerPointCloud.create(positions, { dimension, workers });
    expect(cloud).toHaveLength(480 / dimension);
    const [near, far] = [0.5, 4].map((x) => new Array<number>(dimension).fill(x)) as [number[], number[]];
    const asked: Call[] = [
      ["visibleFrom", far],
      ["visibleFrom", near, { inversion: { power: 3 } }],
      ["visibleFrom", far, { radius: "search" }],
      ["visibleFromAny", [near, far]],
      ["visibleFromAtLeast", 2, [near, far]],
      ["autoRadius", far, "opposite"],
    ];
    for (const call of asked) expect(await ask(cloud, call)).toEqual(ask(direct, call));
    await cloud.dispose();
  });
});

describe("refusals equal the synchronous cloud's", () => {
  const refused: Call[] = [
    ["visibleFrom", viewpoint, { inversion: { power: 2 }, exponent: 1 }],
    ["visibleFrom", viewpoint, { radius: "best" }],
    ["visibleFrom", viewpoint, { denoise: 2500 }],
    ["visibleFromDirection", [0, 0, 0]],
    ["visibleFromDirection", [0, 0, 1], { radius: "search" }],
    ["visibleFromAny", undefined],
    ["visibleFromAny", [[0, 0, NaN]]],
    ["visibleFromAtLeast", 4, viewpoints],
    ["visibleFromAtLeast", 1, []],
    ["autoRadius", viewpoint, "best"],
    ["reconstruct", viewpoint, { maxEdge: -1 }],
    ["reconstruct", [1, 2]],
    ["illuminate", viewpoints, { ambient: 2 }],
    ["illuminate", viewpoints, { triangles: Uint32Array.of(0, 1, 2500) }],
    ["illuminate", 7],
  ];
  it("in code and words", async () => {
    const direct = new PointCloud(sphere);
    const cloud = await WorkerPointCloud.create(sphere);
    for (const call of refused) {
      const [there, here] = [await problemOf(() => ask(cloud, call)), await problemOf(() => ask(direct, call))];
      expect(there).toBeInstanceOf(HprError);
      expect([there.code, there.message]).toEqual([here.code, here.message]);
    }
    await cloud.dispose();
    for (const call of calls) expect((await problemOf(() => ask(cloud, call))).code).toBe("disposed");
  });
});
