// The law of parts: a question about some points of a cloud has the answer of a cloud of these points alone, whatever left
// the others out, here and in workers.
import { init, PointCloud, type SeenBy } from "hidden-point-removal";
import { WorkerPointCloud } from "hidden-point-removal/worker";
import { afterAll, describe, expect, it } from "vitest";

import { asked, CAMERAS, Part, type Place, QUESTIONS, strays } from "../fuzz/border/table";
import { outcomeOf } from "../fuzz/border/outcome";
import { inPart } from "../fuzz/border/parts";
import { bumpySphere, pointsAt } from "./support";

await init();
const positions = bumpySphere(5, 900);
const count = positions.length / 3;
const AT: Place = [0.3, 0.8, 2.5];

const box = [
  [-0.7, -2, -0.3],
  [2, 0.9, 2],
] as const;
const mask = Uint8Array.from({ length: count }, (_, i) => (i % 3 === 0 ? 0 : i % 256));

const all = Array.from({ length: count }, (_, i) => i);
const inMask = (i: number) => mask[i] !== 0;
const inBox = (i: number) =>
  [0, 1, 2].every((k) => box[0][k]! <= positions[3 * i + k]! && positions[3 * i + k]! <= box[1][k]!);
const nearTo =
  (place: ArrayLike<number>, distance: number) =>
  (i: number): boolean =>
    Math.hypot(...[0, 1, 2].map((k) => positions[3 * i + k]! - place[k]!)) <= distance;
const isNear = nearTo(AT, 2.4);
/** The option `within`, and which points it leaves. */
const CHOICES = [
  [{}, () => true],
  [{ mask }, inMask],
  [{ box }, inBox],
  [{ distance: 2.4 }, isNear],
  [{ distance: 2.4, box, mask }, (i: number) => isNear(i) && inBox(i) && inMask(i)],
  [{ mask: new Uint8Array(count) }, () => false],
] as const;

/** A cloud that takes in points bit by bit and has lost some, and one with points that are not finite. */
const grown = new PointCloud(positions.subarray(0, 900));
grown.append(positions.subarray(900));
grown.remove(all.filter((i) => !inMask(i)));
const holed = positions.map((x, i) => (inMask(Math.floor(i / 3)) ? x : NaN));
const whole = new PointCloud(positions);
const remote = await WorkerPointCloud.create(positions, { workers: 2 });
const changed = await WorkerPointCloud.create(positions, { workers: 2 });
await changed.remove(all.filter((i) => !inMask(i)));
const skipping = { nonFinite: "skip" } as const;
const holedRemote = await WorkerPointCloud.create(holed, skipping);
const CLOUDS = { grown, changed, holed: new PointCloud(holed, skipping), holedRemote };
afterAll(() => Promise.all([remote, changed, holedRemote].map((cloud) => cloud.dispose())));

const OPTIONS = [
  {},
  { exponent: 3 },
  { radius: "opposite" },
  { inversion: { power: 2 } },
  { looks: 2, scores: true },
  { looks: 3, thickness: 0.05 },
  { looks: 3, surface: "layered" },
] as const;

const told = async (name: string, part: Part, ask: () => unknown) => {
  const outcome = await outcomeOf(async () => ({ answer: inPart(name, await ask(), part, positions) }));
  return "refused" in outcome ? `${outcome.refused}: ${String(outcome.error)}` : (outcome.answer as object);
};

/** The rows of one camera. */
function rowsOf(answer: SeenBy, camera: number) {
  const entries = Array.from(answer.cameras.keys()).filter((entry) => answer.cameras[entry] === camera);
  const of = (values: Float32Array, each: number) =>
    entries.flatMap((entry) => [...values.subarray(each * entry, each * (entry + 1))]);
  const offsets = Uint32Array.from(answer.offsets, (end) => entries.filter((entry) => entry < end).length);
  return { offsets, pixels: of(answer.pixels, 2), towards: of(answer.towards, 3) };
}

it.each(CHOICES.slice(0, 3))("seenBy within a distance of each camera, and %o", async (within, takesPart) => {
  const distance = 4.3;
  for (const cloud of [whole, remote]) {
    for (const options of OPTIONS.filter((options) => !("scores" in options))) {
      const found = await cloud.seenBy(CAMERAS, { ...options, within: { ...within, distance } });
      for (const [number, camera] of CAMERAS.entries()) {
        const isNear = nearTo((camera.cameraToWorld as number[]).slice(12), distance);
        const part = new Part(
          count,
          all.filter((i) => isNear(i) && takesPart(i)),
        );
        const alone = new PointCloud(pointsAt(positions, [...part.points]));
        const expected = rowsOf(alone.seenBy([camera], options), 0);
        expect(expected.pixels.length).toBeGreaterThan(0);
        const own = new Part(alone.length);
        expect(inPart("seenBy", rowsOf(found, number), part)).toEqual(inPart("seenBy", expected, own));
        alone.dispose();
      }
    }
  }
});

it("the table has every question", () => {
  expect(strays()).toEqual([]);
});

describe.each(Object.keys(QUESTIONS))("%s", (name) => {
  const args = (part: Part) => QUESTIONS[name]!(AT, part, count);
  const ofWhole = new Part(count);

  it.each(CHOICES)("within %o", async (within, takesPart) => {
    const part = new Part(count, all.filter(takesPart));
    // Each of several viewpoints has its own points near it. A station without points is refused, unless they are left out.
    const isOther = "distance" in within && (name === "visibleFromDirection" || args(ofWhole)[0] !== AT);
    if (name === "autoRadius" || isOther || (name === "calibrate" && part.points.length === 0)) return;
    const alone = new PointCloud(pointsAt(positions, [...part.points]));
    for (const options of OPTIONS) {
      const expected = await told(name, new Part(alone.length), () => asked(alone, name, args(part), options));
      for (const cloud of [whole, remote]) {
        const found = await told(name, part, () => asked(cloud, name, args(ofWhole), { ...options, within }));
        expect([options, found]).toEqual([options, expected]);
      }
    }
    alone.dispose();
  });

  it.each(Object.entries(CLOUDS))("of a cloud that has lost points: %s", async (_, cloud) => {
    const part = new Part(count, all.filter(inMask));
    const alone = new PointCloud(pointsAt(positions, [...part.points]));
    for (const options of name === "autoRadius" ? [{}] : OPTIONS) {
      const expected = await told(name, new Part(alone.length), () => asked(alone, name, args(part), options));
      const found = await told(name, part, () => asked(cloud, name, args(ofWhole), options));
      expect([options, found]).toEqual([options, expected]);
    }
    expect([cloud.spacing, await cloud.noise, await cloud.surface]).toEqual([
      alone.spacing,
      alone.noise,
      alone.surface,
    ]);
    alone.dispose();
  });
});
