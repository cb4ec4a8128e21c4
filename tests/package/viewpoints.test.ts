// Several viewpoints, and viewpoints infinitely far away.
import { describe, expect, it } from "vitest";

import { bumpySphere, problemOf, readyPackage } from "./support";

const { PointCloud, ringOfViewpoints, HprError } = await readyPackage();

const sphere = bumpySphere(1, 2000);
const cloud = new PointCloud(sphere);
const viewpoint = [0.5, -1, 5];
const loose = (value: unknown) => value as never;

describe("several viewpoints", () => {
  const viewpoints = [viewpoint, Float32Array.of(4, 0, 1), [-3, 3, 0], [0.1, 0, 0.2]];
  it.each<[string, object]>([
    ["automatic radii", {}],
    ["an exponent", { exponent: 3 }],
    ["searches", { radius: "search" }],
    ["an exponential", { inversion: { exponential: "auto" } }],
    ["votes", { vote: 6 }],
    ["smoothed points", { denoise: 6 }],
  ])("count the single answers: %s", (_, options) => {
    const single = viewpoints.map((place) => cloud.visibleFrom(place, options));
    const seen = new Uint32Array(cloud.length);
    for (const { indices } of single) for (const index of indices) seen[index]!++;
    const atLeast = (k: number) => [...seen.keys()].filter((index) => seen[index]! >= k);

    const any = cloud.visibleFromAny(viewpoints, options);
    expect([...any.indices]).toEqual(atLeast(1));
    expect(any.radius).toBe(Math.max(...single.map(({ radius }) => radius)));
    expect(any.evaluations).toBe(single.reduce((sum, { evaluations }) => sum + evaluations, 0));
    expect(any.inversion).toEqual(single[0]!.inversion);
    expect(any.exponent).toBe(single.find(({ radius }) => radius === any.radius)!.exponent);
    for (const k of [1, 2, 3, 4]) {
      expect([...cloud.visibleFromAtLeast(k, viewpoints, options).indices]).toEqual(atLeast(k));
    }
    expect(atLeast(4).length).toBeLessThan(atLeast(2).length);
  });

  it("see nothing if the list is empty", () => {
    const none = cloud.visibleFromAny([]);
    expect(none).toMatchObject({ count: 0, radius: 0, exponent: 0, evaluations: 0, inversion: "spherical" });
    expect(none.mask()).toEqual(new Uint8Array(cloud.length));
  });

  const refusals: [code: string, names: RegExp, call: () => unknown][] = [
    ["option", /\bk\b.*\b4\b.*got 5/, () => cloud.visibleFromAtLeast(5, viewpoints)],
    ["option", /\bk\b.*got 0/, () => cloud.visibleFromAtLeast(0, viewpoints)],
    ["option", /\bk\b.*1\.5/, () => cloud.visibleFromAtLeast(1.5, viewpoints)],
    ["option", /\bk\b.*"2"/, () => cloud.visibleFromAtLeast(loose("2"), viewpoints)],
    ["option", /\bk\b.*got 1/, () => cloud.visibleFromAtLeast(1, [])],
    ["option", /"latest"/, () => cloud.visibleFromAny(viewpoints, loose({ latest: true }))],
    ["option", /radius and exponent/, () => cloud.visibleFromAny([], { radius: 10, exponent: 2 })],
    ["radius", /farthest/, () => cloud.visibleFromAny(viewpoints, { radius: 4 })],
    ["viewpoint", /viewpoints.*undefined/, () => cloud.visibleFromAny(loose(undefined))],
    ["viewpoint", /viewpoints\[0\].*got 0/, () => cloud.visibleFromAny(loose([0, 0, 5]))],
    ["viewpoint", /viewpoints\[1\].*2 of them/, () => cloud.visibleFromAny([viewpoint, [1, 2]])],
    ["viewpoint", /viewpoints\[0\].*undefined/, () => cloud.visibleFromAny(loose(new Array(1)))],
    ["viewpoint", /NaN/, () => cloud.visibleFromAny([viewpoint, [1, 2, NaN]])],
    ["viewpoint", /direction.*undefined/, () => cloud.visibleFromDirection(loose(undefined))],
    ["viewpoint", /direction.*2 of them/, () => cloud.visibleFromDirection([1, 2])],
    ["viewpoint", /direction.*zero/, () => cloud.visibleFromDirection([0, 0, 0])],
    ["viewpoint", /direction.*NaN/, () => cloud.visibleFromDirection([0, NaN, 1])],
    ["option", /"search".*direction/, () => cloud.visibleFromDirection([0, 0, 1], { radius: "search" })],
    ["option", /"opposite".*direction/, () => cloud.visibleFromDirection([0, 0, 1], { radius: "opposite" })],
    ["option", /power.*direction/, () => cloud.visibleFromDirection([0, 0, 1], { inversion: { power: 2 } })],
    ["option", /exponent/, () => cloud.visibleFromDirection([0, 0, 1], { exponent: -1 })],
    ["radius", /farthest/, () => cloud.visibleFromDirection([0, 0, 1], { radius: 0.1 })],
    ["viewpoint", /target.*2 of them/, () => ringOfViewpoints(viewpoint, [0, 0])],
    ["viewpoint", /NaN/, () => ringOfViewpoints([NaN, 0, 0], [0, 0, 0])],
    ["option", /count.*0/, () => ringOfViewpoints(viewpoint, [0, 0, 0], { count: 0 })],
    ["option", /count.*2\.5/, () => ringOfViewpoints(viewpoint, [0, 0, 0], { count: 2.5 })],
    ["option", /fraction.*-0\.1/, () => ringOfViewpoints(viewpoint, [0, 0, 0], { fraction: -0.1 })],
    ["option", /fraction.*"1"/, () => ringOfViewpoints(viewpoint, [0, 0, 0], loose({ fraction: "1" }))],
    ["option", /"radius"/, () => ringOfViewpoints(viewpoint, [0, 0, 0], loose({ radius: 1 }))],
  ];
  it.each(refusals)("refuse: %s, naming %s, case %#", async (code, names, call) => {
    const problem = await problemOf(call);
    expect(problem).toBeInstanceOf(HprError);
    expect(problem.code).toBe(code);
    expect(problem.message).toMatch(names);
  });
});

describe("a ring of viewpoints", () => {
  it("lies around the viewpoint, at a right angle to the line to the target", () => {
    const target = [0.5, 1, -1];
    const toTarget = target.map((x, axis) => x - viewpoint[axis]!);
    const distance = Math.hypot(...toTarget);
    for (const [options, count, fraction] of [
      [undefined, 4, 0.05],
      [{ count: 7, fraction: 0.5 }, 7, 0.5],
    ] as const) {
      const ring = ringOfViewpoints(viewpoint, target, options);
      expect(ring).toHaveLength(count);
      const spokes = ring.map((place) => place.map((x, axis) => x - viewpoint[axis]!));
      spokes.forEach((spoke, i) => {
        const next = spokes[(i + 1) % count]!;
        expect(Math.hypot(...spoke)).toBeCloseTo(fraction * distance, 12);
        expect(spoke.reduce((sum, x, axis) => sum + x * toTarget[axis]!, 0)).toBeCloseTo(0, 12);
        expect(Math.hypot(...spoke.map((x, axis) => x - next[axis]!))).toBeCloseTo(
          2 * fraction * distance * Math.sin(Math.PI / count),
          12,
        );
      });
    }
  });
});

describe("a direction", () => {
  it.each([
    [0, 0, -1],
    [1, 2, -0.5],
    [-3e200, 1e200, 0],
  ])("is the limit of viewpoints far away: %d %d %d", (...direction) => {
    const most = Math.max(...direction.map(Math.abs));
    const scaled = direction.map((x) => x / most);
    const unit = scaled.map((x) => x / Math.hypot(...scaled));
    const from = (distance: number) => unit.map((x) => -distance * x);
    for (const options of [{}, { inversion: { exponential: "auto" } }] as const) {
      const limit = cloud.visibleFromDirection(direction, options);
      expect(limit.count).toBeGreaterThan(200);
      // At each distance: the number of points that still differ.
      const differing = [3, 300, 30_000].map((distance) => {
        const [near, far] = [cloud.visibleFrom(from(distance), options).mask(), limit.mask()];
        return near.filter((visible, i) => visible !== far[i]).length;
      });
      expect(differing[0]).toBeGreaterThan(differing[2]!);
      expect(differing[2]).toBeLessThanOrEqual(1);
    }
  });
});
