// Meshes and light, which are computed from views.
import { describe, expect, it } from "vitest";

import { bumpySphere, bunny, expectRefusal, problemOf, readyPackage, type Refusal } from "./support";

const { PointCloud } = await readyPackage();

const points = bunny();
const cloud = new PointCloud(points);
const viewpoint = [0, 5, 20];
const loose = (value: unknown) => value as never;

const at = (index: number) => [...points.subarray(3 * index, 3 * index + 3)] as [number, number, number];
type Vector = [number, number, number];
const minus = ([a, b, c]: Vector, [x, y, z]: Vector): Vector => [a - x, b - y, c - z];
/** The triangles of a mesh, as lists of three. */
const listed = (triangles: Uint32Array) =>
  Array.from({ length: triangles.length / 3 }, (_, i) => [...triangles.subarray(3 * i, 3 * i + 3)] as Vector);
const longest = (corners: Vector) =>
  Math.max(...corners.map((a, i) => Math.hypot(...minus(at(a), at(corners[(i + 1) % 3]!)))));

describe("a reconstruction", () => {
  const whole = cloud.reconstruct(viewpoint, { maxEdge: Infinity });
  const triangles = listed(whole.triangles);

  it("also gives the visible points", () => {
    const visible = cloud.visibleFrom(viewpoint);
    expect(whole.indices).toEqual(visible.indices);
    expect(whole.mask()).toEqual(visible.mask());
    expect(whole).toMatchObject({
      count: visible.count,
      radius: visible.radius,
      exponent: visible.exponent,
      evaluations: 0,
      inversion: "spherical",
    });
    expect(whole.triangles).toBeInstanceOf(Uint32Array);
    expect(whole.triangles.buffer.byteLength).toBe(whole.triangles.byteLength);
  });

  it("leaves out triangles with a longer edge than maxEdge, by default 5 spacings", () => {
    for (const maxEdge of [0, 0.3, 1, 3]) {
      const { triangles: kept, indices } = cloud.reconstruct(viewpoint, { maxEdge });
      expect(listed(kept)).toEqual(triangles.filter((corners) => longest(corners) <= maxEdge));
      expect(indices).toEqual(whole.indices);
    }
    // The automatic c is 0.07 spacings.
    const { exponential } = cloud.visibleFrom(viewpoint, { inversion: { exponential: "auto" } }).inversion as {
      exponential: number;
    };
    const spacing = exponential / 0.07;
    const usual = listed(cloud.reconstruct(viewpoint).triangles).map(longest);
    expect(usual).toHaveLength(triangles.filter((corners) => longest(corners) <= 5 * spacing).length);
    expect(usual.length).toBeLessThan(triangles.length);
  });
});

describe("light", () => {
  const lights = [viewpoint, [20, 5, 0], Float64Array.of(-20, 10, 3)];
  const masks = lights.map((light) => cloud.visibleFrom(light).mask());

  it("is ambient + (1 − ambient)·(lights that see the point ÷ lights)", () => {
    for (const ambient of [0, 0.25, 1]) {
      const brightness = cloud.illuminate(lights, { smoothing: 0, ambient });
      expect(brightness).toBeInstanceOf(Float32Array);
      expect(brightness).toHaveLength(cloud.length);
      brightness.forEach((light, i) => {
        const seen = masks.filter((mask) => mask[i] === 1).length;
        expect(light).toBeCloseTo(ambient + ((1 - ambient) * seen) / 3, 6);
      });
    }
    expect(cloud.illuminate(lights, { smoothing: 0 })).toEqual(cloud.illuminate(lights, { smoothing: 0, ambient: 0 }));
  });
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
