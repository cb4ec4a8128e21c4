// Questions that make no sense: the code of each refusal, and the words that name the value and the way out. The fuzzer of
// the border checks codes with arguments of any kind. errors.test.ts has the refusals of clouds and views.
import { describe, expect, it } from "vitest";

import { bumpySphere, expectRefusal, freshPackage, problemOf, readyPackage, type Refusal } from "./support";

const { PointCloud, hiddenPointRemoval, permissibleCurvature, radiusBound, ringOfViewpoints } = await readyPackage();

const COUNT = 2000;
const cloud = new PointCloud(bumpySphere(1, COUNT));
const plane = new PointCloud([0, 1, 2, 3], { dimension: 2 });
const hyper = new PointCloud([0, 1, 2, 3], { dimension: 4 });
const viewpoint = [0.5, -1, 5];
const loose = (value: unknown) => value as never;

describe("within", () => {
  const between = (...corners: unknown[][]) => ({ box: corners });
  it.each<[unknown, RegExp]>([
    [5, /within: the options must be a plain object/],
    [{ radius: 5 }, /within: unknown option "radius"/],
    [{ distance: "5" }, /distance must be a number/],
    [{ distance: -1 }, /within distance must be from 0 to infinity, got -1/],
    [{ distance: NaN }, /within distance/],
    [{ box: [[0, 0, 0]] }, /within box must be \[min, max\], each with 3 numbers/],
    [between([0, 0], [1, 1]), /within box/],
    [between([0, 0, "0"], [1, 1, 1]), /within box/],
    [between([0, 0, 0], [1, 1, NaN]), /within box/],
    [between([2, 0, 0], [1, 1, 1]), /no coordinate of min is above/],
    [{ mask: [1, 0] }, /within mask must be a Uint8Array/],
    [{ mask: new Uint8Array(3) }, /one element for each of 2000 indices, got 3/],
  ])("%o", async (within, message) => {
    for (const ask of [
      () => cloud.visibleFrom(viewpoint, { within: loose(within) }),
      () => cloud.visibleFromAny([viewpoint], { within: loose(within) }),
    ]) {
      await expectRefusal("option", message, ask);
    }
  });
});

describe("a question", () => {
  const viewpoints = [viewpoint, Float32Array.of(4, 0, 1), [-3, 3, 0], [0.1, 0, 0.2]];
  const weights = Array.from({ length: COUNT }, () => -1);
  const pano = (options: object, at: unknown = [0, 0, 0]) => cloud.panorama(loose(at), loose(options));
  const size = { width: 128, height: 64 };
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
    ["viewpoint", /viewpoints must be an array/, () => cloud.coverage(5 as never)],
    ["viewpoint", /viewpoints\[0\]/, () => cloud.coverage([[1, 2]])],
    [
      "viewpoint",
      /viewpoint candidates\[1\] must be finite/,
      () => cloud.placeViewpoints([viewpoints[0]!, [1, 2, NaN]]),
    ],
    [
      "radius",
      new RegExp(`viewpoint ${viewpoints.length}: radius 8`),
      () => cloud.coverage([...viewpoints, [1e9, 0, 0]], { radius: 8 }),
    ],
    ["option", /must not change the cloud/, () => cloud.coverage(viewpoints, { onProgress: () => cloud.append([]) })],
    ["option", /must not change/, () => cloud.placeViewpoints(viewpoints, { onProgress: () => cloud.remove([]) })],
    ["option", /scores cannot be combined with coverage/, () => cloud.coverage(viewpoints, { looks: 3, scores: true })],
    ["option", /scores cannot be combined/, () => cloud.placeViewpoints(viewpoints, { looks: 2, scores: true })],
    ["option", /count must be an integer from 1/, () => cloud.placeViewpoints(viewpoints, { count: 0 })],
    [
      "option",
      /share must be a finite number, above 0 and at most 1, got 1.5/,
      () => cloud.placeViewpoints(viewpoints, { share: 1.5 }),
    ],
    ["option", /one number for each of 2000 indices, got 1/, () => cloud.placeViewpoints(viewpoints, { weights: [1] })],
    ["option", /weights\[0\]/, () => cloud.placeViewpoints(viewpoints, { weights })],
    ["option", /onProgress must be a function/, () => cloud.coverage(viewpoints, { onProgress: 5 as never })],
    ["positions-length", /3 numbers/, () => cloud.sees(viewpoint, loose([1, 2]), {})],
    ["positions-type", /positions/, () => cloud.sees(viewpoint, loose("5"), {})],
    ["non-finite", /first at index 0/, () => cloud.sees(viewpoint, loose([0, 0, NaN]), {})],
    [
      "option",
      /scores cannot be combined with sees/,
      () => cloud.sees(viewpoint, loose([0, 0, 0]), { looks: 3, scores: true }),
    ],
    ["option", /sees.*dimension 3, not 4/, () => hyper.sees([1, 2, 3, 4], [0, 0, 0, 0])],
    ["option", /within.*dimension 3, not 4/, () => hyper.visibleFrom([1, 2, 3, 4], { within: {} })],
    ["option", /within distance.*direction/, () => cloud.visibleFromDirection(viewpoint, { within: { distance: 3 } })],
    ...[
      {},
      { width: 8 },
      { height: 8 },
      { ...size, width: 0 },
      { ...size, width: 16_385 },
      { ...size, height: 1.5 },
      { ...size, height: "8" },
      { ...size, looks: 3, scores: true },
      { ...size, size: 1 },
    ].map((options): Refusal => ["option", /width|height|scores|size/, () => pano(options)]),
    ["viewpoint", /direction.*zero/, () => pano({ ...size, up: [0, 0, 0] })],
    ...[[1, 2], [NaN, 0, 1], "z"].map((up): Refusal => ["viewpoint", /direction up/, () => pano({ ...size, up })]),
    ["viewpoint", /NaN/, () => pano(size, [NaN, 0, 0])],
    ["viewpoint", /2 of them/, () => pano(size, [0, 0])],
    ["radius", /radius/, () => pano({ ...size, radius: 1 })],
    ["option", /panorama.*dimension 3, not 2/, () => plane.panorama([0, 0], size)],
    ["positions-length", /got 5\b.*multiple of 2/, () => new PointCloud([1, 2, 3, 4, 5], { dimension: 2 })],
    ["positions-length", /got 6\b.*multiple of 4/, () => hyper.append(new Float32Array(6))],
    ["non-finite", /index 1/, () => new PointCloud([1, 2, NaN, 4], { dimension: 2 })],
    ["non-finite", /index 1/, () => hyper.append([1, 2, 3, 4, 1, 2, 3, Infinity])],
    ["option", /index 1\b.*length 1/, () => hyper.remove([1])],
    ["option", /stride.*4/, () => new PointCloud([1, 2, 3, 4], { dimension: 4, stride: 3 })],
    ["viewpoint", /2 numbers.*3 of them/, () => plane.visibleFrom([0, 0, 5])],
    ["viewpoint", /NaN/, () => plane.visibleFrom([0, NaN])],
    ["viewpoint", /4 numbers.*3 of them/, () => hyper.visibleFrom([0, 0, 5])],
    ["viewpoint", /must be finite/, () => hyper.visibleFrom([0, 0, 5, NaN])],
    ["viewpoint", /viewpoints\[1\].*2 numbers/, () => plane.visibleFromAny([[0, 0], [0]])],
    [
      "option",
      /\bk\b.*got 3/,
      () =>
        hyper.visibleFromAtLeast(3, [
          [0, 0, 0, 1],
          [0, 0, 0, 2],
        ]),
    ],
    ["option", /reconstruct.*dimension 3, not 2/, () => plane.reconstruct([0, 5])],
    ["option", /illuminate.*dimension 3, not 4/, () => hyper.illuminate([])],
    ["option", /visibleFromDirection.*dimension 3, not 2/, () => plane.visibleFromDirection([0, 1])],
    ["radius", /farthest/, () => hyper.visibleFrom([0, 0, 0, 50], { radius: 1 })],
    ["option", /dimension.*1\b/, () => hiddenPointRemoval([1], [5], { dimension: 1 })],
    ["option", /dimension.*null/, () => new PointCloud([], loose({ dimension: null }))],
    ["option", /\br\b.*\b0$/, () => permissibleCurvature(1, 0, 1)],
    ["option", /\bR\b.*got 1$/, () => permissibleCurvature(1, 2, 1)],
    ["option", /beta.*got 4/, () => permissibleCurvature(2, 1, 4)],
    ["option", /beta.*NaN/, () => permissibleCurvature(2, 1, NaN)],
    ["option", /beta.*undefined/, () => permissibleCurvature(2, 1, loose(undefined))],
    ["option", /\bR\b.*"2"/, () => permissibleCurvature(loose("2"), 1, 1)],
    ["option", /thickness.*-1/, () => radiusBound(-1, 1, 1)],
    ["option", /distance.*Infinity|distance.*infinity/, () => radiusBound(1, Infinity, 1)],
    ["option", /spacing.*null/, () => radiusBound(1, 1, loose(null))],
  ];
  it.each(refusals)("%s, naming %s: case %#", expectRefusal);
});

it("nothing answers before init() has resolved", async () => {
  const fresh = await freshPackage();
  const part = { positions: [0, 0, 1], ids: Uint32Array.of(7) };
  const calls = [
    () => new fresh.PointCloud([]),
    () => fresh.hiddenPointRemoval([], viewpoint),
    () => fresh.mergeVisible([part], viewpoint, { radius: 100 }),
    () => new fresh.Horizon(viewpoint, { radius: 100 }),
    () => fresh.radiusBound(1, 1, 1),
    () => fresh.permissibleCurvature(1, 1, 1),
    () => fresh.ringOfViewpoints([0, 0, 5], [0, 0, 0]),
  ];
  const codes = () => Promise.all(calls.map(async (call) => (await problemOf(call)).code));
  expect(await codes()).toEqual(calls.map(() => "not-initialised"));
  const starting = fresh.init();
  expect(await codes()).toEqual(calls.map(() => "not-initialised"));
  await starting;
  expect(new fresh.PointCloud([])).toHaveLength(0);
});
