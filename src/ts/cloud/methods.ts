import type { Answers } from "../query/answers.js";
import { CALIBRATION_ROWS, calibrationAnswer, calibrationQuery } from "../query/calibration.js";
import {
  type IlluminationOptions,
  LIGHT_ROWS,
  MAP_ROWS,
  MESH_ROWS,
  PANORAMA_ROWS,
  type PanoramaOptions,
  type ReconstructionOptions,
  VIEW_ROWS,
  type VisibilityMapOptions,
  type VisibilityOptions,
} from "../query/option-rows.js";
import { type Checked, type CloudSettings, readOptions, type Rows } from "../query/options.js";
import {
  cameraQuery,
  directionQuery,
  illuminationQuery,
  mapQuery,
  panoramaQuery,
  type Query,
  type QueryKind,
  radiusQuery,
  reconstructionQuery,
  seesQuery,
  severalQuery,
  viewQuery,
} from "../query/queries.js";
import { CameraAnswer, ReconstructionAnswer, VisibilityAnswer } from "./visibility.js";
import { VisibilityMap } from "./visibility-map.js";

type View = Checked<VisibilityOptions, typeof VIEW_ROWS>;

/** A method that asks a cloud one question. `Given`: its options, as their rows have checked them. */
interface Method<Kind extends QueryKind, Given> {
  /** The number of arguments before the options. */
  readonly count: number;
  readonly rows: Rows;
  readonly question: (settings: CloudSettings, given: Given, ...args: readonly unknown[]) => Query<Kind>;
  readonly answer: (found: Answers[Kind], given: Record<string, unknown>) => unknown;
}

function method<Kind extends QueryKind, Given = View>(
  count: number,
  rows: Rows,
  question: Method<Kind, Given>["question"],
  answer: Method<Kind, Given>["answer"],
): Method<Kind, Given> {
  return { count, rows, question, answer };
}

const visibility = (found: Answers["visibleFrom"]) => new VisibilityAnswer(found);

/** The questions to a cloud, for `PointCloud` and for a cloud in a worker. */
export const METHODS = {
  visibleFrom: method<"visibleFrom">(
    1,
    VIEW_ROWS,
    ({ dimension }, given, viewpoint) => viewQuery(dimension, viewpoint, given),
    visibility,
  ),
  visibilityMap: method<"visibilityMap", Checked<VisibilityMapOptions, typeof MAP_ROWS>>(
    1,
    MAP_ROWS,
    ({ dimension }, given, viewpoint) => mapQuery(dimension, viewpoint, given),
    (made) => new VisibilityMap(made),
  ),
  panorama: method<"panorama", Checked<PanoramaOptions, typeof PANORAMA_ROWS>>(
    1,
    PANORAMA_ROWS,
    ({ dimension }, given, viewpoint) => panoramaQuery(dimension, viewpoint, given),
    (made) => made,
  ),
  visibleFromDirection: method<"visibleFromDirection">(
    1,
    VIEW_ROWS,
    ({ dimension }, given, direction) => directionQuery(dimension, direction, given),
    visibility,
  ),
  visibleFromAny: method<"visibleFromSeveral" | "visibleFromSeats">(
    1,
    VIEW_ROWS,
    ({ dimension }, given, viewpoints) => severalQuery(dimension, viewpoints, given),
    visibility,
  ),
  visibleFromAtLeast: method<"visibleFromSeveral" | "visibleFromSeats">(
    2,
    VIEW_ROWS,
    ({ dimension }, given, k, viewpoints) => severalQuery(dimension, viewpoints, given, { k }),
    visibility,
  ),
  visibleFromCamera: method<"visibleFromCamera">(
    1,
    VIEW_ROWS,
    ({ dimension }, given, camera) => cameraQuery(dimension, camera, given),
    (found) => new CameraAnswer(found),
  ),
  sees: method<"sees">(
    2,
    VIEW_ROWS,
    (settings, given, viewpoint, positions) => seesQuery(settings, viewpoint, positions, given),
    ({ seen }) => seen,
  ),
  autoRadius: method<"autoRadius">(
    2,
    {},
    ({ dimension }, _, viewpoint, rule) => radiusQuery(dimension, viewpoint, rule),
    (chosen) => chosen,
  ),
  reconstruct: method<"reconstruct", Checked<ReconstructionOptions, typeof MESH_ROWS>>(
    1,
    MESH_ROWS,
    ({ dimension }, given, viewpoint) => reconstructionQuery(dimension, viewpoint, given),
    (found) => new ReconstructionAnswer(found),
  ),
  calibrate: method<"calibrate">(
    1,
    CALIBRATION_ROWS,
    ({ dimension }, given, stations) => calibrationQuery(dimension, stations, given),
    calibrationAnswer,
  ),
  illuminate: method<"illuminate", Checked<IlluminationOptions, typeof LIGHT_ROWS>>(
    1,
    LIGHT_ROWS,
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
): { query: Query; given: Record<string, unknown>; answer: (found: never) => unknown } {
  const { count, rows, question, answer } = METHODS[name] as Method<QueryKind, never>;
  const given = readOptions(args[count], rows, settings.dimension, others);
  const query = question(settings, given as never, ...args.slice(0, count));
  return { query, given, answer: (found) => answer(found, given) };
}
