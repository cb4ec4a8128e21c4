// What is refused: wrong options, places and lists, by every question that takes them, here and in workers. Each refusal has
// its code, and names the argument and the value.
import * as hpr from "hidden-point-removal";
import { WorkerPointCloud } from "hidden-point-removal/worker";
import { afterAll, describe, expect, it } from "vitest";

import { describe as shown } from "../../src/ts/base/errors.js";
import { JUNK } from "../fuzz/border/argument";
import { asked, Part, QUESTIONS } from "../fuzz/border/table";
import { bumpySphere, expectRefusal, freshPackage, problemOf, type Refusal } from "./support";

await hpr.init();
const { hiddenPointRemoval, permissibleCurvature, PointCloud, radiusBound, ringOfViewpoints } = hpr;

const COUNT = 300;
const ALL = new Part(COUNT);
const sphere = bumpySphere(1, COUNT);
const cloud = new PointCloud(sphere);
const remote = await WorkerPointCloud.create(sphere, { workers: 2 });
afterAll(() => remote.dispose());
const plane = new PointCloud([0, 1, 2, 3], { dimension: 2 });
const hyper = new PointCloud([0, 1, 2, 3], { dimension: 4 });
const viewpoint = [0.5, -1, 5];
const loose = (value: unknown) => value as never;

/** One option, with each of these values. */
const each = (name: string, ...values: unknown[]) => values.map((value) => ({ [name]: value }));
const looked = (name: string, ...values: unknown[]) => values.map((value) => ({ looks: 3, [name]: value }));

/** The last option of each is wrong by itself, in every question about views. */
const WRONG: [code: string, options: object[]][] = [
  ["radius", each("radius", NaN, Infinity, 0, -7, 1.5e308)],
  ["option", each("radius", "best", "search", null)],
  ["option", each("exponent", "3", -1, NaN)],
  ["option", each("inversion", "cubic", null, {}, { gamma: 2 }, { looks: [1, 2] }, { power: 2, exponential: 1 })],
  ["option", each("inversion", ...each("power", "auto", 1, 16.5, NaN))],
  ["option", each("inversion", ...each("exponential", "far", 0, Infinity))],
  ["option", each("looks", 1, 4, 2.5, "3", true)],
  ["option", looked("scores", 1)],
  ["option", looked("thickness", -1, NaN, Infinity, "thin")],
  ["option", looked("surface", "rough", 3)],
  ["option", each("within", 5, { radius: 5 }, ...each("distance", "5", -1, NaN))],
  ["option", each("within", ...each("mask", [1, 0], new Uint8Array(3)), { box: [[0, 0, 0]] })],
  ["option", each("within", { box: [[0, 0], [1, 1]] }, { box: [[0, 0, "0"], [1, 1, 1]] })], // prettier-ignore
  ["option", each("within", { box: [[0, 0, 0], [1, 1, NaN]] }, { box: [[2, 0, 0], [1, 1, 1]] })], // prettier-ignore
  // Nobody knows the first, and the others are gone.
  ["option", ["foo", "draft", "sample", "denoise", "vote"].map((name) => ({ [name]: 5 }))],
];
/** Good options, but not together. */
const CLASHES = [
  ...each("radius", 10, "auto").map((radius) => ({ ...radius, exponent: 2 })),
  ...each("radius", 10, "auto").map((radius) => ({ ...radius, looks: 3 })),
  { looks: 3, exponent: 2 },
  { looks: 3, inversion: "spherical" },
  { exponent: 2, inversion: { power: 2 } },
  { exponent: 2, inversion: { exponential: 1 } },
  { radius: "opposite", inversion: { power: 2 } },
  { radius: "opposite", inversion: { exponential: "auto" } },
  { radius: 100, inversion: { exponential: 1 } },
  ...[{ scores: true }, { thickness: 0.1 }, { surface: "clean" }],
];
const MANY = each("onProgress", 5);
/** The same of some questions. */
const OWN: Record<string, object[]> = {
  reconstruct: [...each("maxEdge", -1, NaN, "5"), { ambient: 1 }],
  illuminate: [
    ...each("ambient", 1.5, -0.5, NaN, "0"),
    ...each("smoothing", -1, 0.5, 1001),
    ...each("triangles", [0, 1, 2], new Uint32Array(4), Uint32Array.of(0, 1, COUNT)),
    { maxEdge: 1 },
  ],
  panorama: [...each("width", undefined, 0, 16_385, "8"), ...each("height", undefined, 1.5), { size: 1 }],
  visibilityMap: each("points", 15, 16.5, "64"),
  coverage: MANY,
  seenBy: MANY,
  transfer: [...MANY, ...each("merge", "max"), ...each("weights", "none"), ...each("sampling", "cubic")],
  placeViewpoints: [
    ...MANY,
    ...each("count", 0, 1.5),
    ...each("share", 0, 1.5, "1"),
    ...each("weights", 5, [1], new Array(COUNT).fill(-1), new Array(COUNT).fill(1e308)),
  ],
};
/** Options that only some questions take. Each question here refuses the last of them, and names itself. */
const ELSEWHERE: [names: string[], words: RegExp, options: object][] = [
  [["visibleFromDirection"], /"opposite".*direction/, { radius: "opposite" }],
  [["visibleFromDirection"], /power.*direction/, { inversion: { power: 2 } }],
  [["visibleFromDirection"], /within distance.*direction/, { within: { distance: 3 } }],
  [["visibleFromAny", "visibleFromAtLeast"], /scores.*several/, { looks: 3, scores: true }],
  ...["coverage", "seenBy", "placeViewpoints", "sees", "panorama", "transfer", "visibilityMap"].map(
    (name): (typeof ELSEWHERE)[number] => [[name], /scores/, { looks: 3, scores: true }],
  ),
  [["reconstruct", "illuminate"], /looks.*(reconstruct|illuminate)/, { looks: 3 }],
];
/** What holds no numbers, with the words that a refusal has for it. */
const NO_LISTS = JUNK.map(([, make]): [make: () => unknown, words: string] => [make, shown(make())]);
/** What is no place. */
const PLACES: typeof NO_LISTS = [
  ...NO_LISTS,
  [() => [1, 2], "2 of them"],
  [() => [1, 2, 3, 4], "4 of them"],
  [() => ["1", 2, 3], '"1"'],
  [() => [0, NaN, 5], "NaN"],
  [() => [0, 0, Infinity], "inf"],
  [() => ({ x: 1, y: 2 }), ""],
];

/** The name of the last value, and the value. */
function wordsOf(options: object): string[] {
  const [name, value] = Object.entries(options).at(-1) as [string, unknown];
  if (typeof value !== "object" || value === null) return [name, shown(value).replace("e+", "e")];
  const isBag = Object.getPrototypeOf(value) === Object.prototype && Object.keys(value).length === 1;
  return isBag ? wordsOf(value) : [name];
}

async function refuses(code: string, words: readonly string[], call: () => unknown): Promise<void> {
  const problem = await problemOf(call);
  expect([words, problem]).toMatchObject([words, { name: "HprError", code }]);
  const message = problem.message.toLowerCase();
  const missing = words.filter((word) => !message.includes(word.toLowerCase()));
  // What nobody takes is refused whatever its value is, and of a list its length is told.
  const isWhole = /unknown option|cannot be combined|must be given|of them/.test(message);
  if (!isWhole) expect([problem.message, missing]).toEqual([problem.message, []]);
}

describe.each(Object.keys(QUESTIONS))("%s", (name) => {
  const ask = (options: object, at: unknown) =>
    [cloud, remote].map((of) => () => asked(of, name, QUESTIONS[name]!(at, ALL, COUNT), options));

  it.runIf(!["autoRadius", "calibrate"].includes(name))("options", async () => {
    for (const [code, all] of [...WRONG, ["option", OWN[name] ?? []] as const]) {
      for (const options of all) {
        for (const call of ask(options, viewpoint)) await refuses(code, wordsOf(options), call);
      }
    }
    for (const options of CLASHES) {
      for (const call of ask(options, viewpoint)) await refuses("option", Object.keys(options), call);
    }
    for (const [names, words, options] of ELSEWHERE) {
      if (names.includes(name)) for (const call of ask(options, viewpoint)) await expectRefusal("option", words, call);
    }
    for (const call of ask({ radius: 0.01 }, viewpoint)) await expectRefusal("radius", /farthest/, call);
  });

  it.runIf(!["visibleFromCamera", "seenBy", "transfer"].includes(name))("places", async () => {
    for (const [make, words] of PLACES) {
      for (const call of ask({}, make())) await refuses("viewpoint", [words], call);
    }
  });

  it("of a cloud that was disposed of", async () => {
    const gone = [new PointCloud([1, 2, 3]), await WorkerPointCloud.create([1, 2, 3])];
    for (const of of gone) {
      await of.dispose();
      await expectRefusal("disposed", /disposed/, () => asked(of, name, QUESTIONS[name]!(viewpoint, ALL, COUNT)));
    }
  });
});

describe("lists", () => {
  const creating = (positions: unknown) => WorkerPointCloud.create(loose(positions));
  const calls: Record<string, (positions: unknown) => unknown> = {
    PointCloud: (positions) => new PointCloud(loose(positions)),
    create: creating,
    sees: (positions) => cloud.sees(viewpoint, loose(positions)),
    "a worker's sees": (positions) => remote.sees(viewpoint, loose(positions)),
    append: (positions) => {
      cloud.append(loose(positions));
    },
    "a worker's append": (positions) => remote.append(loose(positions)),
  };
  it.each(Object.entries(calls))("of positions: %s", async (_, call) => {
    for (const [make, words] of NO_LISTS) await refuses("positions-type", [words], () => call(make()));
    for (const wrong of ["2", undefined, null, [1, 2, 3], 5n]) {
      await refuses("positions-type", ["positions[1]", shown(wrong)], () => call([1, wrong, 3]));
    }
    await expectRefusal("positions-type", /positions\[2\].*undefined/, () => call([1, 2, , 4, 5, 6]));
    await expectRefusal("positions-length", /got 4\b/, () => call(new Int32Array(4)));
    await expectRefusal("non-finite", /index 1\b/, () => call([1, 2, 3, NaN, 5, 6]));
    await expectRefusal("too-large", /points/, () => call({ length: 3 * 2 ** 40 }));
  });

  it.each([
    ["remove", (indices: unknown) => cloud.remove(loose(indices))],
    ["a worker's remove", (indices: unknown) => remote.remove(loose(indices))],
  ])("of indices: %s", async (_, call) => {
    for (const [make, words] of NO_LISTS) {
      await refuses("option", [words.includes("Big") ? "0n" : words], () => call(make()));
    }
    for (const wrong of [-1, 1.5, NaN, 2 ** 32, "1", undefined]) {
      await refuses("option", ["indices[1]", shown(wrong)], () => call([0, wrong]));
    }
    await expectRefusal("option", /index 300\b.*length 300/, () => call([3, 300]));
  });
});

it("options of a cloud", async () => {
  const wrong = [
    ...each("dimension", 1, 65, 2.5, "3", null),
    ...each("stride", 2, 3.5, "3", null),
    ...each("nonFinite", "ignore", true),
    { strid: 4 },
  ];
  const inWorker = [...each("workers", 0, 1.5, 65, "2", NaN), ...each("onProgress", 1), ...each("transfer", 1)];
  const create = (options: object) => () => WorkerPointCloud.create(sphere, options);
  for (const options of wrong) await refuses("option", wordsOf(options), () => new PointCloud(sphere, options));
  for (const options of [...wrong, ...inWorker]) await refuses("option", wordsOf(options), create(options));
  for (const [, make] of JUNK.slice(1)) {
    const words = /options must be a plain object|unknown option/;
    await expectRefusal("option", words, () => new PointCloud(sphere, loose(make())));
    await expectRefusal("option", words, () => cloud.visibleFrom(viewpoint, loose(make())));
  }
});

describe("a question", () => {
  const places = [viewpoint, Float32Array.of(4, 0, 1), [-3, 3, 0], [0.1, 0, 0.2]];
  const up = (at: unknown) => () => cloud.panorama([0, 0, 0], { width: 8, height: 4, up: loose(at) });
  const scan = (...stations: unknown[]) => () => cloud.calibrate(stations as []); // prettier-ignore
  const at = [0, 0, 0];
  const refusals: Refusal[] = [
    ["option", /\bk\b.*\b4\b.*got 5/, () => cloud.visibleFromAtLeast(5, places)],
    ["option", /\bk\b.*got 0/, () => cloud.visibleFromAtLeast(0, places)],
    ["option", /\bk\b.*1\.5/, () => cloud.visibleFromAtLeast(1.5, places)],
    ["option", /\bk\b.*"2"/, () => cloud.visibleFromAtLeast(loose("2"), places)],
    ["option", /\bk\b.*got 1/, () => cloud.visibleFromAtLeast(1, [])],
    ["option", /"latest"/, () => cloud.visibleFrom(viewpoint, loose({ latest: true }))],
    ["option", /rule.*"best"/, () => cloud.autoRadius(viewpoint, loose("best"))],
    ["option", /rule.*\b7$/, () => cloud.autoRadius(viewpoint, loose(7))],
    ["viewpoint", /viewpoints.*undefined/, () => cloud.visibleFromAny(loose(undefined))],
    ["viewpoint", /viewpoints\[0\].*got 0/, () => cloud.visibleFromAny(loose([0, 0, 5]))],
    ["viewpoint", /viewpoints\[1\].*2 of them/, () => cloud.visibleFromAny([viewpoint, [1, 2]])],
    ["viewpoint", /viewpoints\[0\].*undefined/, () => cloud.visibleFromAny(loose(new Array(1)))],
    ["viewpoint", /lights.*undefined/, () => cloud.illuminate(loose(undefined))],
    ["viewpoint", /candidates\[1\] must be finite/, () => cloud.placeViewpoints([viewpoint, [1, 2, NaN]])],
    ["viewpoint", /direction.*zero/, () => cloud.visibleFromDirection([0, 0, 0])],
    ["viewpoint", /direction.*zero/, up([0, 0, 0])],
    ...[[1, 2], [NaN, 0, 1], "z"].map((one): Refusal => ["viewpoint", /direction up/, up(one)]),
    ["radius", /viewpoint 1: radius 8/, () => cloud.coverage([viewpoint, [1e9, 0, 0]], { radius: 8 })],
    ["option", /must not change/, () => cloud.coverage(places, { onProgress: () => cloud.append([]) })],
    ["option", /must not change/, () => cloud.placeViewpoints(places, { onProgress: () => cloud.remove([]) })],
    ["option", /stations.*at least one/, scan()],
    ["option", /stations.*at least one/, () => cloud.calibrate(loose(7))],
    ["option", /stations\[0\].*one of indices and mask/, scan({ viewpoint: at })],
    ["option", /stations\[0\].*one of indices and mask/, scan({ viewpoint: at, indices: [1], mask: sphere })],
    ["option", /stations\[0\].*no points/, scan({ viewpoint: at, indices: [] })],
    ["option", /stations\[0\].*index 99999999/, scan({ viewpoint: at, indices: [99_999_999] })],
    ["option", /mask.*bytes/, scan({ viewpoint: at, mask: new Uint8Array(3) })],
    ["option", /stations\[0\].*7/, scan(7)],
    ["viewpoint", /target.*2 of them/, () => ringOfViewpoints(viewpoint, [0, 0])],
    ["viewpoint", /NaN/, () => ringOfViewpoints([NaN, 0, 0], at)],
    ["option", /count.*0/, () => ringOfViewpoints(viewpoint, at, { count: 0 })],
    ["option", /count.*2\.5/, () => ringOfViewpoints(viewpoint, at, { count: 2.5 })],
    ["option", /fraction.*-0\.1/, () => ringOfViewpoints(viewpoint, at, { fraction: -0.1 })],
    ["option", /fraction.*"1"/, () => ringOfViewpoints(viewpoint, at, loose({ fraction: "1" }))],
    ["option", /"radius"/, () => ringOfViewpoints(viewpoint, at, loose({ radius: 1 }))],
    ["option", /\br\b.*\b0$/, () => permissibleCurvature(1, 0, 1)],
    ["option", /\bR\b.*got 1$/, () => permissibleCurvature(1, 2, 1)],
    ["option", /beta.*got 4/, () => permissibleCurvature(2, 1, 4)],
    ["option", /beta.*undefined/, () => permissibleCurvature(2, 1, loose(undefined))],
    ["option", /thickness.*-1/, () => radiusBound(-1, 1, 1)],
    ["option", /distance.*infinity/i, () => radiusBound(1, Infinity, 1)],
    ["option", /spacing.*null/, () => radiusBound(1, 1, loose(null))],
    ["positions-length", /got 9\b.*multiple of 4/, () => new PointCloud(new Float64Array(9), { stride: 4 })],
  ];
  it.each(refusals)("%s, naming %s: case %#", expectRefusal);
});

describe("in other dimensions", () => {
  const refusals: Refusal[] = [
    ["option", /looks.*dimension 3/, () => plane.visibleFrom([5, 5], { looks: 3 })],
    ["option", /sees.*dimension 3, not 4/, () => hyper.sees([1, 2, 3, 4], [0, 0, 0, 0])],
    ["option", /within.*dimension 3, not 4/, () => hyper.visibleFrom([1, 2, 3, 4], { within: {} })],
    ["option", /panorama.*dimension 3, not 2/, () => plane.panorama([0, 0], { width: 8, height: 4 })],
    ["option", /reconstruct.*dimension 3, not 2/, () => plane.reconstruct([0, 5])],
    ["option", /illuminate.*dimension 3, not 4/, () => hyper.illuminate([])],
    ["option", /visibleFromDirection.*dimension 3, not 2/, () => plane.visibleFromDirection([0, 1])],
    ["option", /dimension.*1\b/, () => hiddenPointRemoval([1], [5], { dimension: 1 })],
    ["option", /index 1\b.*length 1/, () => hyper.remove([1])],
    ["option", /stride.*4/, () => new PointCloud([1, 2, 3, 4], { dimension: 4, stride: 3 })],
    ["option", /\bk\b.*got 3/, () => hyper.visibleFromAtLeast(3, [[0, 0, 0, 1], [0, 0, 0, 2]])], // prettier-ignore
    ["positions-length", /got 5\b.*multiple of 2/, () => new PointCloud([1, 2, 3, 4, 5], { dimension: 2 })],
    ["positions-length", /got 6\b.*multiple of 4/, () => hyper.append(new Float32Array(6))],
    ["non-finite", /index 1/, () => new PointCloud([1, 2, NaN, 4], { dimension: 2 })],
    ["non-finite", /index 1/, () => hyper.append([1, 2, 3, 4, 1, 2, 3, Infinity])],
    ["viewpoint", /2 numbers.*3 of them/, () => plane.visibleFrom([0, 0, 5])],
    ["viewpoint", /NaN/, () => plane.visibleFrom([0, NaN])],
    ["viewpoint", /4 numbers.*3 of them/, () => hyper.visibleFrom([0, 0, 5])],
    ["viewpoint", /must be finite/, () => hyper.visibleFrom([0, 0, 5, NaN])],
    ["viewpoint", /viewpoints\[1\].*2 numbers/, () => plane.visibleFromAny([[0, 0], [0]])],
    ["radius", /farthest/, () => hyper.visibleFrom([0, 0, 0, 50], { radius: 1 })],
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
