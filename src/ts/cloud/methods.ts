import type { Answers } from "../query/answers.js";
import { type CloudSettings, givenOptions } from "../query/options.js";
import {
  cameraQuery,
  directionQuery,
  ILLUMINATION_OPTIONS,
  illuminationQuery,
  mapQuery,
  panoramaQuery,
  type Query,
  type QueryKind,
  radiusQuery,
  RECONSTRUCTION_OPTIONS,
  reconstructionQuery,
  seesQuery,
  severalQuery,
  viewQuery,
} from "../query/queries.js";
import { MAP_OPTIONS } from "../query/map-options.js";
import { PANORAMA_OPTIONS } from "../query/panorama-options.js";
import { VIEW_OPTIONS } from "../query/view-options.js";
import { CameraAnswer, ReconstructionAnswer, VisibilityAnswer } from "./visibility.js";
import { VisibilityMap } from "./visibility-map.js";

type Given = Record<string, unknown>;

/** A method that asks a cloud one question. */
interface Method<Kind extends QueryKind = QueryKind> {
  /** The number of arguments before the options. */
  readonly count: number;
  readonly options: readonly string[];
  readonly question: (settings: CloudSettings, given: Given, ...args: readonly unknown[]) => Query<Kind>;
  readonly answer: (found: Answers[Kind]) => unknown;
}

function method<Kind extends QueryKind>(
  count: number,
  options: readonly string[],
  question: Method<Kind>["question"],
  answer: Method<Kind>["answer"],
): Method<Kind> {
  return { count, options, question, answer };
}

const visibility = (found: Answers["visibleFrom"]) => new VisibilityAnswer(found);

/** The questions to a cloud, for `PointCloud` and for a cloud in a worker. */
export const METHODS = {
  visibleFrom: method<"visibleFrom">(
    1,
    VIEW_OPTIONS,
    ({ dimension }, given, viewpoint) => viewQuery(dimension, viewpoint, given),
    visibility,
  ),
  visibilityMap: method<"visibilityMap">(
    1,
    MAP_OPTIONS,
    ({ dimension }, given, viewpoint) => mapQuery(dimension, viewpoint, given),
    (made) => new VisibilityMap(made),
  ),
  panorama: method<"panorama">(
    1,
    PANORAMA_OPTIONS,
    ({ dimension }, given, viewpoint) => panoramaQuery(dimension, viewpoint, given),
    (made) => made,
  ),
  visibleFromDirection: method<"visibleFromDirection">(
    1,
    VIEW_OPTIONS,
    ({ dimension }, given, direction) => directionQuery(dimension, direction, given),
    visibility,
  ),
  visibleFromAny: method<"visibleFromSeveral" | "visibleFromSeats">(
    1,
    VIEW_OPTIONS,
    ({ dimension }, given, viewpoints) => severalQuery(dimension, viewpoints, given),
    visibility,
  ),
  visibleFromAtLeast: method<"visibleFromSeveral" | "visibleFromSeats">(
    2,
    VIEW_OPTIONS,
    ({ dimension }, given, k, viewpoints) => severalQuery(dimension, viewpoints, given, { k }),
    visibility,
  ),
  visibleFromCamera: method<"visibleFromCamera">(
    1,
    VIEW_OPTIONS,
    ({ dimension }, given, camera) => cameraQuery(dimension, camera, given),
    (found) => new CameraAnswer(found),
  ),
  sees: method<"sees">(
    2,
    VIEW_OPTIONS,
    (settings, given, viewpoint, positions) => seesQuery(settings, viewpoint, positions, given),
    ({ seen }) => seen,
  ),
  autoRadius: method<"autoRadius">(
    2,
    [],
    ({ dimension }, _, viewpoint, rule) => radiusQuery(dimension, viewpoint, rule),
    (chosen) => chosen,
  ),
  reconstruct: method<"reconstruct">(
    1,
    RECONSTRUCTION_OPTIONS,
    ({ dimension }, given, viewpoint) => reconstructionQuery(dimension, viewpoint, given),
    (found) => new ReconstructionAnswer(found),
  ),
  illuminate: method<"illuminate">(
    1,
    ILLUMINATION_OPTIONS,
    ({ dimension }, given, lights) => illuminationQuery(dimension, lights, given),
    ({ brightness }) => brightness,
  ),
};

export type MethodName = keyof typeof METHODS;

/** A question that was read and checked, and how its answer is told. `given`: its options and those of `others`. */
export function readQuestion(
  name: MethodName,
  settings: CloudSettings,
  args: readonly unknown[],
  others: readonly string[] = [],
): { query: Query; given: Given; answer: (found: never) => unknown } {
  const { count, options, question, answer } = METHODS[name];
  const given = givenOptions(args[count], options, others);
  return { query: question(settings, given, ...args.slice(0, count)), given, answer };
}
