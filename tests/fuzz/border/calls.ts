// Every question that can be asked of a cloud, with arguments of any kind.
import fc from "fast-check";
import type { PointCloud } from "hidden-point-removal";
import type { WorkerPointCloud } from "hidden-point-removal/worker";
import { type Argument, bad, good, JUNK, named } from "./argument.js";
import { directionOptions, illuminationOptions, reconstructionOptions, viewOptions } from "./options.js";
import { viewpoint, viewpoints } from "./points.js";

/** A cloud of either kind. A method of a `WorkerPointCloud` answers with a promise. */
type AnyCloud = PointCloud | WorkerPointCloud;
type Method =
  | "visibleFrom"
  | "visibleFromDirection"
  | "visibleFromAny"
  | "visibleFromAtLeast"
  | "autoRadius"
  | "reconstruct"
  | "illuminate";

export interface Call {
  name: string;
  method: Method;
  codes: readonly string[];
  /** The call must be refused. */
  sure: boolean;
  /** An argument of the call names points by their indices. */
  hasTriangles: boolean;
  on(cloud: AnyCloud): unknown;
  /** Asks the same question with plain arrays and objects. */
  plainlyOn(cloud: PointCloud): unknown;
}

function call(method: Method, args: readonly Argument[], more: readonly string[] = []): Call {
  const invoke = (cloud: AnyCloud, values: unknown[]) =>
    (cloud[method] as (...values: unknown[]) => unknown)(...values);
  return {
    name: `${method}(${args.map(({ name }) => name).join(", ")})`,
    method,
    codes: [...args.flatMap(({ codes }) => codes), ...more],
    sure: more.length > 0 || args.some(({ sure }) => sure),
    hasTriangles: args.some(({ meaning }) => typeof meaning === "object" && meaning !== null && "triangles" in meaning),
    on: (cloud) =>
      invoke(
        cloud,
        args.map(({ make }) => make()),
      ),
    plainlyOn: (cloud) =>
      invoke(
        cloud,
        args.map(({ meaning }) => meaning),
      ),
  };
}

const rule = named(
  fc.constantFrom(
    ...[undefined, "auto", "opposite"].map((it) => good(String(it), it)),
    ...JUNK.filter(([, make]) => make() !== undefined).map(([name, make]) => bad("option", name, make, undefined)),
  ),
);

/** The required number of viewpoints. It is good from 1 to `count`, the number of viewpoints given. */
const least = (count: number) =>
  named(
    fc.oneof(
      fc
        .integer({ min: -1, max: 6 })
        .map((k) => (k >= 1 && k <= count ? good(`${k}`, k) : bad("option", `${k}`, () => k, k))),
      fc.constantFrom(...[NaN, 1.5, "1", null, undefined, 1n].map((k) => bad("option", String(k), () => k, 0))),
    ),
  );

/** Any question to a cloud of this dimension. */
export function anyCall(dimension: number): fc.Arbitrary<Call> {
  const inSpaceOnly = dimension === 3 ? [] : ["option"];
  const calls = fc.oneof(
    {
      weight: 3,
      arbitrary: fc.tuple(viewpoint(dimension), viewOptions).map((args) => call("visibleFrom", args)),
    },
    fc
      .tuple(viewpoint(3), directionOptions)
      .map(([ahead, options]) => call("visibleFromDirection", [directed(ahead), options], inSpaceOnly)),
    fc.tuple(viewpoints(dimension), viewOptions).map((args) => call("visibleFromAny", args)),
    viewpoints(dimension)
      .chain((list) => fc.tuple(least(list.meaning.length), fc.constant(list), viewOptions))
      .map((args) => call("visibleFromAtLeast", args)),
    fc.tuple(viewpoint(dimension), rule).map((args) => call("autoRadius", args)),
    fc.tuple(viewpoint(dimension), reconstructionOptions).map((args) => call("reconstruct", args, inSpaceOnly)),
    fc.tuple(viewpoints(dimension), illuminationOptions).map((args) => call("illuminate", args, inSpaceOnly)),
  );
  return named(calls);
}

/** Marks a direction of zero as bad, because it must be refused. */
function directed(ahead: Argument<readonly number[]>): Argument<readonly number[]> {
  const isZero = !ahead.sure && ahead.meaning.every((x) => x === 0);
  return isZero ? { ...ahead, codes: ["viewpoint"], sure: true } : ahead;
}
