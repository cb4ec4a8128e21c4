// Several viewpoints, and viewpoints infinitely far away.
import { describe, expect, it } from "vitest";

import { bumpySphere, expectRefusal, readyPackage, type Refusal } from "./support";

const { PointCloud, ringOfViewpoints } = await readyPackage();

const sphere = bumpySphere(1, 2000);
const cloud = new PointCloud(sphere);
const viewpoint = [0.5, -1, 5];
const loose = (value: unknown) => value as never;

describe("several viewpoints", () => {
  const viewpoints = [viewpoint, Float32Array.of(4, 0, 1), [-3, 3, 0], [0.1, 0, 0.2]];

  it("see nothing if the list is empty", () => {
    const none = cloud.visibleFromAny([]);
    expect(none).toMatchObject({ count: 0, radius: 0, exponent: 0, evaluations: 0, inversion: "spherical" });
    expect(none.mask()).toEqual(new Uint8Array(cloud.length));
  });

  const refusals: Refusal[] = [
    ["option", /\bk\b.*\b4\b.*got 5/, () => cloud.visibleFromAtLeast(5, viewpoints)],
    ["option", /\bk\b.*got 0/, () => cloud.visibleFromAtLeast(0, viewpoints)],
    ["option", /\bk\b.*1\.5/, () => cloud.visibleFromAtLeast(1.5, viewpoints)],
    ["option", /\bk\b.*"2"/, () => cloud.visibleFromAtLeast(loose("2"), viewpoints)],
    ["option", /\bk\b.*got 1/, () => cloud.visibleFromAtLeast(1, [])],
    ["option", /"latest"/, () => cloud.visibleFromAny(viewpoints, loose({ latest: true }))],
    ["option", /radius and exponent/, () => cloud.visibleFromAny([], loose({ radius: 10, exponent: 2 }))],
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
    ["option", /"opposite".*direction/, () => cloud.visibleFromDirection([0, 0, 1], { radius: "opposite" })],
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
  it.each(refusals)("refuse: %s, naming %s, case %#", expectRefusal);
});
