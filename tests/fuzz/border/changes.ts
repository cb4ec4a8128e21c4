// Properties of clouds that change: any sequence of steps, on this thread, and in a worker without waiting for it. Each answer
// is that of a cloud of the points that are left.
import fc from "fast-check";
import { PointCloud } from "hidden-point-removal";
import { WorkerPointCloud } from "hidden-point-removal/worker";
import { type Argument, dressed, named } from "./argument.js";
import { agree, judge, type Outcome, outcomeOf, require } from "./outcome.js";
import { inPart } from "./parts.js";
import { coordinates } from "./scenes.js";
import { type AnyCloud, asked, Part, type Place, QUESTIONS } from "./table.js";

type Numbers = Argument<readonly number[]>;
type Step = { name: string } & (
  | { append: Numbers }
  | { remove: Numbers }
  | { ask: string; at: Place; options: object }
  | { dispose: true }
);

const loose = (value: unknown) => value as never;

/** A map depends on earlier maps, and a station has no points left where all of its own are gone. */
const NAMES = Object.keys(QUESTIONS).filter((name) => name !== "visibilityMap" && name !== "calibrate");
const OPTIONS = [{}, { exponent: 2 }, { looks: 3 }, { inversion: { exponential: "auto" } }];
const PLACES: readonly Place[] = [[0.5, -3, 11], [2, 2, 2], [3.25, 3, 0.5]]; // prettier-ignore

const steps = fc.array(
  named<Step>(
    fc.oneof(
      {
        weight: 3,
        arbitrary: coordinates(3, 8)
          .chain(dressed)
          .map((append) => ({ append, name: `append(${append.name})` })),
      },
      {
        weight: 3,
        arbitrary: fc
          .array(fc.nat({ max: 25 }), { maxLength: 6 })
          .chain(dressed)
          .map((remove) => ({ remove, name: `remove(${remove.name})` })),
      },
      {
        weight: 5,
        arbitrary: fc
          .tuple(fc.constantFrom(...NAMES), fc.constantFrom(...PLACES), fc.constantFrom(...OPTIONS))
          .map(([ask, at, options]) => ({ ask, at, options, name: `${ask} from ${at.join()} ${JSON.stringify(options)}` })), // prettier-ignore
      },
      { weight: 1, arbitrary: fc.constant({ dispose: true as const, name: "dispose" }) },
    ),
  ),
  { minLength: 1, maxLength: 8 },
);

async function walk(cloud: AnyCloud, start: number[], list: readonly Step[]): Promise<void> {
  const points = [...start];
  let kept = Array.from({ length: start.length / 3 }, (_, i) => i);
  let isGone = false;
  const checks: Promise<void>[] = [];
  const expect = (name: string, outcome: Promise<Outcome>, isRefused = false) => {
    const codes = [...(isRefused ? ["option"] : []), ...(isGone ? ["disposed"] : [])];
    checks.push(outcome.then((found) => judge(name, { codes, sure: codes.length > 0 }, found)));
  };
  for (const step of list) {
    const { name } = step;
    const length = points.length / 3;
    if ("append" in step) {
      expect(name, outcomeOf(() => cloud.append(loose(step.append.make())))); // prettier-ignore
      if (isGone) continue;
      points.push(...step.append.meaning);
      kept.push(...Array.from({ length: step.append.meaning.length / 3 }, (_, i) => length + i));
    } else if ("remove" in step) {
      const isRefused = step.remove.meaning.some((i) => i >= length);
      expect(name, outcomeOf(() => cloud.remove(loose(step.remove.make()))), isRefused); // prettier-ignore
      if (!isGone && !isRefused) kept = kept.filter((i) => !step.remove.meaning.includes(i));
    } else if ("ask" in step) {
      const options = step.ask === "autoRadius" ? {} : step.options;
      const ask = (of: AnyCloud, part: Part) =>
        asked(of, step.ask, QUESTIONS[step.ask]!(step.at, part, length), options);
      // The question is asked at once, before later steps change the cloud.
      const part = new Part(length, [...kept]);
      const found = outcomeOf(async () => inPart(step.ask, await ask(cloud, new Part(length)), part));
      if (isGone) {
        expect(name, found);
        continue;
      }
      const alone = new PointCloud(part.points.flatMap((i) => points.slice(3 * i, 3 * i + 3)));
      const right = outcomeOf(async () => inPart(step.ask, await ask(alone, part), new Part(alone.length)));
      checks.push(Promise.all([found, right]).then(([one, other]) => agree(name, one, other)).finally(() => alone.dispose())); // prettier-ignore
    } else {
      // flight.ts tests workers that end while they work.
      await Promise.allSettled(checks);
      void cloud.dispose();
      isGone = true;
    }
    if (cloud instanceof PointCloud && !isGone) {
      require(cloud.length === points.length / 3, `after ${name}: length is ${cloud.length}`);
    }
  }
  // Waits for all outcomes first. Otherwise, after one failure, the rejections of others would be unhandled.
  const failed = (await Promise.allSettled(checks)).find((check) => check.status === "rejected");
  await cloud.dispose();
  if (failed !== undefined) {
    throw failed.reason;
  }
}

export const changes = fc.asyncProperty(coordinates(3, 12), steps, async (start, list) => {
  await walk(new PointCloud(start), start, list);
  await walk(await WorkerPointCloud.create(start, { shared: true }), start, list);
});
