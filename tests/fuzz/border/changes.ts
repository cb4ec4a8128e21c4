// Properties of clouds that change: any sequence of steps, on this thread, and in a worker without waiting for it.
import fc from "fast-check";
import { PointCloud } from "hidden-point-removal";
import { WorkerPointCloud } from "hidden-point-removal/worker";
import { type Argument, bad, dressed, JUNK, named } from "./argument.js";
import { anyCall, type Call } from "./calls.js";
import { judge, type Outcome, outcomeOf, require } from "./outcome.js";
import { coordinates, positions } from "./points.js";
import { compare, reference } from "./single.js";

type AnyCloud = PointCloud | WorkerPointCloud;
type Step = { name: string } & (
  | { kind: "append"; points: Argument<readonly number[]> }
  | { kind: "remove"; indices: Argument<readonly number[]> }
  | { kind: "ask"; call: Call }
  | { kind: "dispose" }
);

const loose = (value: unknown) => value as never;

/** Indices to remove. Some are beyond the cloud's end. The model finds these. */
const indices = named(
  fc.oneof(
    { weight: 6, arbitrary: fc.array(fc.nat({ max: 25 }), { maxLength: 6 }).chain(dressed) },
    {
      weight: 1,
      arbitrary: fc.constantFrom(
        ...[-1, 1.5, NaN, 2 ** 32, "1", null, undefined, 1n].map((index) =>
          bad<readonly number[]>("option", String(index), () => [0, index], []),
        ),
      ),
    },
    {
      weight: 1,
      arbitrary: fc.constantFrom(
        // Arrays of BigInts, and objects without numbers, are not lists of indices either.
        ...JUNK.filter(([name]) => name !== "a length that is a string").map(([name, make]) =>
          bad<readonly number[]>("option", name, make, []),
        ),
      ),
    },
  ),
);

const steps = fc.array(
  named(
    fc.oneof(
      {
        weight: 3,
        arbitrary: positions(3, 3, false, 8).map((points): Step => ({
          kind: "append",
          points,
          name: `append(${points.name})`,
        })),
      },
      {
        weight: 3,
        arbitrary: indices.map((list): Step => ({ kind: "remove", indices: list, name: `remove(${list.name})` })),
      },
      { weight: 5, arbitrary: anyCall(3).map((call): Step => ({ kind: "ask", call, name: call.name })) },
      { weight: 1, arbitrary: fc.constant<Step>({ kind: "dispose", name: "dispose" }) },
    ),
  ),
  { minLength: 1, maxLength: 8 },
);

/** The right contents of a cloud: all points that it ever got, and whether each is still there. */
class Model {
  points: number[];
  there: boolean[];
  disposed = false;

  constructor(points: number[]) {
    this.points = [...points];
    this.there = Array<boolean>(points.length / 3).fill(true);
  }

  get kept(): number[] {
    return [...this.there.keys()].filter((i) => this.there[i]);
  }

  append({ sure, meaning }: Argument<readonly number[]>): void {
    if (!sure && !this.disposed) {
      this.points.push(...meaning);
      this.there.push(...Array<boolean>(meaning.length / 3).fill(true));
    }
  }

  /** Removes points. Returns the codes that a refusal may have. */
  remove({ sure, codes, meaning }: Argument<readonly number[]>): readonly string[] {
    if (sure) {
      return codes;
    }
    if (meaning.some((i) => i >= this.there.length)) {
      return ["option"];
    }
    if (!this.disposed) {
      for (const i of meaning) this.there[i] = false;
    }
    return [];
  }
}

async function walk(cloud: AnyCloud, start: number[], list: readonly Step[]): Promise<void> {
  const model = new Model(start);
  const checks: Promise<void>[] = [];
  for (const step of list) {
    const gone = model.disposed ? ["disposed"] : [];
    const expect = (outcome: Promise<Outcome>, codes: readonly string[]) => {
      const expected = { codes: [...codes, ...gone], sure: codes.length > 0 || gone.length > 0 };
      checks.push(
        outcome.then((found) => {
          judge(step.name, expected, found);
        }),
      );
    };
    switch (step.kind) {
      case "append":
        expect(
          outcomeOf(() => cloud.append(loose(step.points.make()))),
          step.points.codes,
        );
        model.append(step.points);
        break;
      case "remove":
        expect(
          outcomeOf(() => cloud.remove(loose(step.indices.make()))),
          model.remove(step.indices),
        );
        break;
      case "ask":
        checks.push(asked(cloud, step.call, model));
        break;
      case "dispose":
        // flight.ts tests workers that end while they work.
        await Promise.allSettled(checks);
        void cloud.dispose();
        model.disposed = true;
        break;
    }
    if (cloud instanceof PointCloud && !model.disposed) {
      require(cloud.length === model.there.length, `after ${step.name}: length is ${cloud.length}`);
    }
  }
  // Waits for all outcomes first. Otherwise, after one failure, the rejections of others would be unhandled.
  const failed = (await Promise.allSettled(checks)).find((check) => check.status === "rejected");
  await cloud.dispose();
  if (failed !== undefined) {
    throw failed.reason;
  }
}

async function asked(cloud: AnyCloud, call: Call, { points, kept, there, disposed }: Model): Promise<void> {
  if (disposed) {
    judge(call.name, { codes: ["disposed"], sure: true }, await outcomeOf(() => call.on(cloud)));
    return;
  }
  // The question is asked at once, before later steps change the cloud.
  const found = outcomeOf(() => call.on(cloud));
  const here = kept.flatMap((i) => points.slice(3 * i, 3 * i + 3));
  const expected = await reference(call, 3, here, kept, there.length);
  // The reference numbers its points differently, so the question's triangles would be others there.
  compare(call, await found, call.hasTriangles ? await found : expected, kept);
}

export const changes = fc.asyncProperty(coordinates(3, 12), steps, async (start, list) => {
  await walk(new PointCloud(start), start, list);
  await walk(await WorkerPointCloud.create(start, { shared: true }), start, list);
});
