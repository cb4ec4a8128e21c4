// Properties of single calls: any cloud and any question, on this thread and in a worker.
import fc from "fast-check";
import { hiddenPointRemoval, PointCloud } from "hidden-point-removal";
import { WorkerPointCloud } from "hidden-point-removal/worker";
import type { Argument } from "./argument.js";
import { anyCall, type Call } from "./calls.js";
import { type CloudShape, cloudShape, type Options, viewOptions } from "./options.js";
import { agree, judge, type Outcome, outcomeOf, require } from "./outcome.js";
import { positions, viewpoint } from "./points.js";

const loose = (value: unknown) => value as never;

/** A cloud that is made from any arguments, and questions to it. */
const scene = cloudShape.chain(({ options, ...shape }) =>
  fc.record({
    shape: fc.constant(shape),
    options: fc.constant(options),
    points: positions(shape.dimension, shape.stride, shape.skips),
    calls: fc.array(anyCall(shape.dimension), { minLength: 1, maxLength: 3 }),
  }),
);

/** The points that take part, as plain numbers in double precision. `kept` holds the index of each. */
export function present(
  numbers: readonly number[],
  { dimension, stride }: CloudShape,
): { kept: number[]; points: number[] } {
  const kept: number[] = [];
  const points: number[] = [];
  for (let i = 0; i * stride < numbers.length; i++) {
    const point = numbers.slice(i * stride, i * stride + dimension);
    if (point.every(Number.isFinite)) {
      kept.push(i);
      points.push(...point);
    }
  }
  return { kept, points };
}

/** The answer of a cloud that has only the points that take part. The answer uses their original indices. */
export async function reference(
  call: Call,
  dimension: number,
  points: number[],
  kept: readonly number[],
  length: number,
) {
  const cloud = new PointCloud(points, { dimension });
  const found = await outcomeOf(() => call.plainlyOn(cloud));
  cloud.dispose();
  if ("refused" in found) {
    return found;
  }
  const back = (indices: number[]) => indices.map((i) => kept[i]!);
  if (Array.isArray(found.answer)) {
    const brightness = new Array<number>(length).fill(0);
    (found.answer as number[]).forEach((x, i) => (brightness[kept[i]!] = x));
    return { answer: brightness };
  }
  const answer = found.answer as Record<string, unknown>;
  if ("indices" in answer) {
    answer["indices"] = back(answer["indices"] as number[]);
    answer["length"] = length;
  }
  if ("triangles" in answer) {
    answer["triangles"] = back(answer["triangles"] as number[]);
  }
  return found;
}

/** Leaves out the brightness of skipped and removed points, because it may be 0 or ambient. */
function onlyPresent(found: Outcome, kept: readonly number[]): Outcome {
  return "answer" in found && Array.isArray(found.answer)
    ? { answer: kept.map((i) => (found.answer as number[])[i]) }
    : found;
}

/** Checks that a call is refused if it must be, and that its answer equals the expected one. */
export function compare(call: Call, found: Outcome, expected: Outcome, kept: readonly number[]): void {
  judge(call.name, call, found);
  // If several arguments are wrong, the refusal may name any of them. So refusals are not compared.
  if (!call.sure) {
    agree(call.name, onlyPresent(found, kept), onlyPresent(expected, kept));
  }
}

export const questions = fc.asyncProperty(scene, async ({ shape, options, points, calls }) => {
  const making = { codes: [...options.codes, ...points.codes], sure: options.sure || points.sure };
  const clouds: (PointCloud | WorkerPointCloud)[] = [];
  const builders = [
    () => new PointCloud(loose(points.make()), loose(options.make())),
    () => WorkerPointCloud.create(loose(points.make()), loose(shared(options))),
  ];
  for (const builder of builders) {
    const built = await outcomeOf(async () => clouds.push(await builder()));
    judge(`a cloud of ${points.name}, ${options.name}`, making, built);
  }
  const { kept, points: own } = present(points.meaning, shape);
  const length = points.meaning.length / shape.stride;
  for (const cloud of clouds) {
    require(cloud.length === length, `length is ${cloud.length}, not ${length}`);
    require(cloud.skipped === length - kept.length, `skipped is ${cloud.skipped}`);
    require(Number.isFinite(cloud.spacing) && cloud.spacing >= 0, `spacing is ${cloud.spacing}`);
  }
  const [first] = clouds;
  if (first !== undefined) {
    for (const call of calls) {
      // The reference numbers its points differently, so the question's triangles would be others there.
      const expected =
        call.hasTriangles && kept.length < length
          ? await outcomeOf(() => call.on(first))
          : await reference(call, shape.dimension, own, kept, length);
      for (const cloud of clouds) {
        compare(call, await outcomeOf(() => call.on(cloud)), expected, kept);
      }
    }
  }
  for (const cloud of clouds) await cloud.dispose();
});

/** The same options for a `WorkerPointCloud`, in the one worker that all of them share. */
function shared(options: Options): unknown {
  const value = options.make();
  const isBag = options.codes.length === 0;
  return isBag ? { ...(value as object | undefined), shared: true } : value;
}

/** Tests `hiddenPointRemoval`, which does the whole operation in one call. */
export const oneShot = fc.asyncProperty(
  cloudShape.chain(({ options, ...shape }) =>
    fc.record({
      shape: fc.constant(shape),
      options: fc.constant(options),
      points: positions(shape.dimension, shape.stride, shape.skips),
      from: viewpoint(shape.dimension),
      view: viewOptions,
    }),
  ),
  async ({ shape, options, points, from, view }) => {
    // In this call, `dimension` would be accepted among the view's options.
    fc.pre(options.codes.length === 0 && !("dimension" in (view.meaning ?? {})));
    // Missing and refused options of the view cannot be combined with the cloud's options.
    const all = () => (view.meaning === undefined ? view.make() : { ...options.meaning, ...view.meaning });
    fc.pre(view.sure || view.meaning !== undefined || Object.keys(options.meaning ?? {}).length === 0);
    const parts: Argument[] = [points, from, view];
    const found = await outcomeOf(() => hiddenPointRemoval(loose(points.make()), loose(from.make()), loose(all())));
    judge(
      "hiddenPointRemoval",
      { codes: parts.flatMap(({ codes }) => codes), sure: parts.some(({ sure }) => sure) },
      found,
    );
    if ("answer" in found) {
      const cloud = new PointCloud(points.meaning, options.meaning);
      agree(
        `hiddenPointRemoval, ${shape.dimension}`,
        found,
        await outcomeOf(() => cloud.visibleFrom(from.meaning, view.meaning)),
      );
      cloud.dispose();
    }
  },
);
