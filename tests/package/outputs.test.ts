// Meshes and light, which are computed from views.
import { describe, expect, it } from "vitest";

import { bumpySphere, bunny, expectRefusal, problemOf, readyPackage, type Refusal } from "./support";

const { PointCloud } = await readyPackage();

const loose = (value: unknown) => value as never;

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

describe("refusals", () => {
  const small = new PointCloud(bumpySphere(1, 100));
  const lights = [[0, 0, 5]];
  const light = (options: unknown) => () => small.illuminate(lights, loose(options));
  const refusals: Refusal[] = [
    ["option", /maxEdge.*-1/, () => small.reconstruct([0, 0, 5], { maxEdge: -1 })],
    ["option", /maxEdge.*NaN/, () => small.reconstruct([0, 0, 5], { maxEdge: NaN })],
    ["option", /maxEdge.*"5"/, () => small.reconstruct([0, 0, 5], loose({ maxEdge: "5" }))],
    ["option", /"ambient"/, () => small.reconstruct([0, 0, 5], loose({ ambient: 1 }))],
    ["option", /radius and exponent/, () => small.reconstruct([0, 0, 5], loose({ radius: 10, exponent: 2 }))],
    ["radius", /farthest/, () => small.reconstruct([0, 0, 5], { radius: 1 })],
    ["viewpoint", /NaN/, () => small.reconstruct([0, 0, NaN])],
    ["viewpoint", /lights.*undefined/, () => small.illuminate(loose(undefined))],
    ["viewpoint", /lights\[0\].*\b4 of them/, () => small.illuminate([[1, 2, 3, 4]])],
    ["viewpoint", /Infinity/, () => small.illuminate([[1, 2, Infinity]])],
    ["option", /ambient.*1\.5/, light({ ambient: 1.5 })],
    ["option", /ambient.*-0\.5/, light({ ambient: -0.5 })],
    ["option", /ambient.*NaN/, light({ ambient: NaN })],
    ["option", /ambient.*"0"/, light({ ambient: "0" })],
    ["option", /smoothing.*-1/, light({ smoothing: -1 })],
    ["option", /smoothing.*0\.5/, light({ smoothing: 0.5 })],
    ["option", /smoothing.*1001/, light({ smoothing: 1001 })],
    ["option", /triangles.*Array/, light({ triangles: [0, 1, 2] })],
    ["option", /triangles.*got 4/, light({ triangles: new Uint32Array(4) })],
    ["option", /triangles\[2\].*100\b.*got 100/, light({ triangles: Uint32Array.of(0, 1, 100) })],
    ["option", /"maxEdge"/, light({ maxEdge: 1 })],
  ];
  it.each(refusals)("%s, naming %s: case %#", expectRefusal);

  it("everything, after the cloud was disposed of", async () => {
    const gone = new PointCloud([1, 2, 3]);
    gone.dispose();
    const calls = [
      () => gone.reconstruct([0, 0, 5]),
      () => gone.illuminate([]),
      () => gone.visibleFromAny([]),
      () => gone.visibleFromAtLeast(1, [[0, 0, 5]]),
      () => gone.visibleFromDirection([0, 0, 1]),
      () => gone.autoRadius([0, 0, 5], "opposite"),
    ];
    for (const call of calls) expect((await problemOf(call)).code).toBe("disposed");
  });
});
