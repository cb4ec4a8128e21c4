// Properties of single calls: any cloud, any question, here and in a worker.
import fc from "fast-check";
import { hiddenPointRemoval, PointCloud } from "hidden-point-removal";
import { WorkerPointCloud } from "hidden-point-removal/worker";
import type { Argument } from "./argument.js";
import { anyCall, type Call } from "./calls.js";
import { type CloudShape, cloudShape, type Options, viewOptions } from "./options.js";
import { agree, judge, type Outcome, outcomeOf, require } from "./outcome.js";
import { positions, viewpoint } from "./points.js";

const loose = (value: unknown) => value as never;

/** A cloud of any arguments, and questions to it. */
const scene = cloudShape.chain(({ options, ...shape }) =>
  fc.record({
    shape: fc.constant(shape),
    options: fc.constant(options),
    points: positions(shape.dimension, shape.stride, shape.skips),
    calls: fc.array(anyCall(shape.dimension), { minLength: 1, maxLength: 3 }),
  }),
);

/** Points that take part: as plain numbers in double precision, with the index that each had. */
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

/** What a cloud of the points that take part alone answers, with the indices they had. */
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

/** Of skipped and removed points nothing is promised but that they are not lit: 0 or ambient. */
function onlyPresent(found: Outcome, kept: readonly number[]): Outcome {
  return "answer" in found && Array.isArray(found.answer)
    ? { answer: kept.map((i) => (found.answer as number[])[i]) }
    : found;
}

/** Accepted or refused as it has to be, and answered as a cloud that was built of plain arrays answers. */
export function compare(call: Call, found: Outcome, expected: Outcome, kept: readonly number[]): void {
  judge(call.name, call, found);
  // Of several things that are wrong, either may be said first.
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
      // The reference has other indices, and so other triangles.
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

/** The same options for the worker's client, in the worker that all of them share. */
function shared(options: Options): unknown {
  const value = options.make();
  const isBag = options.codes.length === 0;
  return isBag ? { ...(value as object | undefined), shared: true } : value;
}

/** The whole operation in one call. */
export const oneShot = fc.asyncProperty(
  cloudShape.chain(({ options, ...shape }) =>
    fc.record({
      shape: fc.constant(shape),
      options: fc.constant(options),
      points: positions(shape.dimension, shape.stride, shape.skips),
      from: viewpoint(shape.dimension),
      view: viewOptions(shape.dimension),
    }),
  ),
  async ({ shape, options, points, from, view }) => {
    // `dimension` among the view's options would count here.
    fc.pre(options.codes.length === 0 && !("dimension" in (view.meaning ?? {})));
    // No options, or refused ones, hold nothing that could be added to the cloud's.
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
