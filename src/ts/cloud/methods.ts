import { allocating, describe, HprError, typeTag } from "../base/errors.js";
import { plainView, typedArrayType } from "../base/typed-arrays.js";
import { CALIBRATION_ROWS, calibrationAnswer, calibrationQuery } from "../query/calibration.js";
import { isCamera, isCameraSeat, readCamera, readSeats } from "../query/camera.js";
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
import {
  type Checked,
  type CloudSettings,
  entriesOf,
  number,
  readOptions,
  requireLow,
  requireSpace,
  type Rows,
} from "../query/options.js";
import { packed, readPositions, readViewpoint, readViewpoints } from "../query/positions.js";
import type { Answers, Query, QueryKind } from "../query/queries.js";
import { hasScores, refuseScores, ruleSettings, viewSettings } from "../query/view-options.js";
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
    ({ dimension }, given, viewpoint) => ({
      kind: "visibleFrom",
      viewpoint: readViewpoint(viewpoint, dimension),
      settings: viewSettings(given, dimension),
    }),
    visibility,
  ),
  visibilityMap: method<"visibilityMap", Checked<VisibilityMapOptions, typeof MAP_ROWS>>(
    1,
    MAP_ROWS,
    ({ dimension }, given, viewpoint) => {
      requireSpace("visibilityMap", dimension);
      const place = readViewpoint(viewpoint, 3) as [number, number, number];
      const settings = viewSettings(given, dimension);
      const { points = 0, towards, origin } = given;
      const camera = isCamera(towards) ? readCamera(towards) : undefined;
      const cone = camera || towards === undefined ? [0, 0, 0, 0] : readCone(towards);
      const from = origin === undefined ? [Infinity, 0, 0] : readViewpoint(origin, 3, "origin");
      return {
        kind: "visibilityMap",
        viewpoint: place,
        settings,
        map: Float64Array.of(points, ...cone, ...from),
        camera,
      };
    },
    (made) => new VisibilityMap(made),
  ),
  panorama: method<"panorama", Checked<PanoramaOptions, typeof PANORAMA_ROWS>>(
    1,
    PANORAMA_ROWS,
    ({ dimension }, given, viewpoint) => {
      requireSpace("panorama", dimension);
      const place = readViewpoint(viewpoint, 3);
      const settings = viewSettings(given, dimension);
      const { width, height, up = [0, 0, 1] } = given;
      for (const [name, size] of Object.entries({ width, height }) as [string, number | undefined][]) {
        if (size === undefined) {
          throw new HprError("option", `${name} must be given: an integer from 1 to 16384`);
        }
      }
      return { kind: "panorama", viewpoint: place, settings, width, height, up: readViewpoint(up, 3, "direction up") };
    },
    (made) => made,
  ),
  visibleFromDirection: method<"visibleFromDirection">(
    1,
    VIEW_ROWS,
    ({ dimension }, given, direction) => {
      requireSpace("visibleFromDirection", dimension);
      const ahead = readViewpoint(direction, 3, "direction");
      return { kind: "visibleFromDirection", direction: ahead, settings: viewSettings(given, dimension) };
    },
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
    ({ dimension }, given, camera) => {
      requireSpace("visibleFromCamera", dimension);
      const numbers = readCamera(camera);
      return { kind: "visibleFromCamera", camera: numbers, settings: viewSettings(given, dimension) };
    },
    (found) => new CameraAnswer(found),
  ),
  sees: method<"sees">(
    2,
    VIEW_ROWS,
    ({ dimension, stride }, given, viewpoint, positions) => {
      requireLow("sees", dimension);
      const place = readViewpoint(viewpoint, dimension);
      const settings = viewSettings(given, dimension);
      const numbers = packed(readPositions(positions, stride), stride, dimension);
      const own = allocating(`${numbers.length} coordinates`, () => Float64Array.from(numbers));
      return { kind: "sees", viewpoint: place, positions: own, settings };
    },
    ({ seen }) => seen,
  ),
  autoRadius: method<"autoRadius">(
    2,
    {},
    ({ dimension }, _, viewpoint, rule) => ({
      kind: "autoRadius",
      viewpoint: readViewpoint(viewpoint, dimension),
      settings: ruleSettings(rule),
    }),
    (chosen) => chosen,
  ),
  reconstruct: method<"reconstruct", Checked<ReconstructionOptions, typeof MESH_ROWS>>(
    1,
    MESH_ROWS,
    ({ dimension }, given, viewpoint) => {
      requireSpace("reconstruct", dimension);
      const place = readViewpoint(viewpoint, dimension);
      return {
        kind: "reconstruct",
        viewpoint: place,
        settings: viewSettings(given, dimension),
        maxEdge: given.maxEdge,
      };
    },
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
    ({ dimension }, given, lights) => {
      requireSpace("illuminate", dimension);
      const positions = readViewpoints(lights, dimension, "lights");
      const settings = viewSettings(given, dimension);
      const triangles = readTriangles(given.triangles);
      const { smoothing = 1, ambient = 0 } = given;
      return { kind: "illuminate", lights: positions, settings, triangles, smoothing, ambient };
    },
    ({ brightness }) => brightness,
  ),
};

/** Asks for points visible from at least `k` of the viewpoints. Without `k`, from at least one. */
function severalQuery(
  dimension: number,
  viewpoints: unknown,
  given: View,
  least?: { k: unknown },
): Query<"visibleFromSeveral"> | Query<"visibleFromSeats"> {
  const seats = readSeats(viewpoints, dimension, "viewpoints");
  let k = 1;
  if (least !== undefined) {
    const count = seats.length;
    const isCount = Number.isInteger(least.k) && (least.k as number) >= 1 && (least.k as number) <= count;
    if (!isCount) {
      throw new HprError(
        "option",
        `k must be an integer from 1 to the number of viewpoints, ${count}, got ${describe(least.k)}`,
      );
    }
    k = least.k as number;
  }
  const settings = viewSettings(given, dimension);
  if (seats.some(isCameraSeat)) {
    refuseScores({ scores: hasScores(settings) }, "several cameras");
    return { kind: "visibleFromSeats", seats, k, settings };
  }
  const positions = allocating(`${seats.length} viewpoints`, () =>
    Float64Array.from(seats.flatMap((seat) => [...seat])),
  );
  return { kind: "visibleFromSeveral", viewpoints: positions, k, settings };
}

function readCone(towards: unknown): number[] {
  if (typeTag(towards) !== "Object") {
    throw new HprError("option", `towards must be a camera or { direction, angle }, got ${describe(towards)}`);
  }
  const given = entriesOf("towards", towards, ["direction", "angle"]);
  const angle = number(given, "angle") ?? Number.NaN;
  if (!(angle > 0 && angle <= 360)) {
    throw new HprError(
      "option",
      `the angle of towards must be above 0 and at most 360, got ${describe(given["angle"])}`,
    );
  }
  return [...readViewpoint(given["direction"], 3, "direction of towards"), angle];
}

/** A copy of the triangles. Their indices are checked later, when the cloud is asked. */
function readTriangles(triangles: unknown): Uint32Array<ArrayBuffer> | undefined {
  if (triangles === undefined) {
    return undefined;
  }
  const corners =
    typedArrayType(triangles) === "Uint32Array" ? plainView(triangles as Uint32Array, Uint32Array) : undefined;
  if (corners === undefined) {
    throw new HprError("option", `triangles must be a Uint32Array, not transferred away, got ${describe(triangles)}`);
  }
  if (corners.length % 3 !== 0) {
    throw new HprError("option", `triangles must be three indices each, got ${corners.length}`);
  }
  return allocating(`${corners.length / 3} triangles`, () => corners.slice());
}

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
