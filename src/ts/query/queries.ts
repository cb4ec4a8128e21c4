import { describe, HprError } from "../base/errors.js";
import { allocating } from "../base/memory.js";
import { readCamera } from "./camera.js";
import { mapNumbers, type MapNumbers } from "./map-options.js";
import type {
  IlluminationOptions,
  LIGHT_ROWS,
  MAP_ROWS,
  MESH_ROWS,
  PANORAMA_ROWS,
  PanoramaOptions,
  ReconstructionOptions,
  VIEW_ROWS,
  VisibilityMapOptions,
  VisibilityOptions,
} from "./option-rows.js";
import { type Checked, type CloudSettings, requireLow, requireSpace } from "./options.js";
import { type PanoramaSize, panoramaSize } from "./panorama-options.js";
import { packed, readPositions, readViewpoint, readViewpoints } from "./positions.js";
import { isCameraSeat, readSeats, type Seat } from "./seats.js";
import { plainView, typedArrayType } from "../base/typed-arrays.js";
import { hasScores, refuseScores, ruleSettings, type ViewSettings, viewSettings } from "./view-options.js";

export type { IlluminationOptions, ReconstructionOptions };

/**
 * The questions to a cloud, by kind. Their arguments are read, copied and checked for type. Their
 * points have the core's number of coordinates (see `coreDimension`).
 */
export interface Questions {
  visibleFrom: { viewpoint: number[]; settings: ViewSettings };
  visibilityMap: MapNumbers & { viewpoint: [number, number, number]; settings: ViewSettings };
  panorama: PanoramaSize & { viewpoint: number[]; settings: ViewSettings };
  visibleFromDirection: { direction: number[]; settings: ViewSettings };
  /** Asks for points visible from at least `k` of the viewpoints. These are stored one after another. */
  visibleFromSeveral: { viewpoints: Float64Array<ArrayBuffer>; k: number; settings: ViewSettings };
  /** The same, where some seats are cameras. */
  visibleFromSeats: { seats: Seat[]; k: number; settings: ViewSettings };
  /** `camera` as `readCamera` lists it. */
  visibleFromCamera: {
    camera: Float64Array<ArrayBuffer>;
    settings: ViewSettings;
    /** Whether the answer has `towards`. */
    towards?: boolean;
  };
  /** `positions` have the core's number of coordinates. */
  sees: { viewpoint: number[]; positions: Float64Array; settings: ViewSettings };
  autoRadius: { viewpoint: number[]; settings: ViewSettings };
  noise: object;
  /** The stations: the viewpoint of each, the indices of all of them, and where those of each end. */
  calibrate: {
    viewpoints: Float64Array<ArrayBuffer>;
    ends: Uint32Array<ArrayBuffer>;
    indices: Uint32Array<ArrayBuffer>;
    /** The lengths of the masks that stations were given by. */
    masks: (number | undefined)[];
    settings: ViewSettings;
  };
  surface: object;
  reconstruct: { viewpoint: number[]; settings: ViewSettings; maxEdge: number | undefined };
  illuminate: {
    lights: Float64Array<ArrayBuffer>;
    settings: ViewSettings;
    triangles: Uint32Array<ArrayBuffer> | undefined;
    smoothing: number;
    ambient: number;
  };
}

export type QueryKind = keyof Questions;
/** `argument`: which of several viewpoints or cameras it is about, for errors. */
export type Query<K extends QueryKind = QueryKind> = { [P in K]: { kind: P; argument?: string } & Questions[P] }[K];

// In the functions below, `given` holds options that their rows have checked.

type View = Checked<VisibilityOptions, typeof VIEW_ROWS>;

export function viewQuery(dimension: number, viewpoint: unknown, given: View): Query<"visibleFrom"> {
  const position = readViewpoint(viewpoint, dimension);
  return { kind: "visibleFrom", viewpoint: position, settings: viewSettings(given, dimension) };
}

export function cameraQuery(dimension: number, camera: unknown, given: View): Query<"visibleFromCamera"> {
  requireSpace("visibleFromCamera", dimension);
  const numbers = readCamera(camera);
  return { kind: "visibleFromCamera", camera: numbers, settings: viewSettings(given, dimension) };
}

export function seesQuery(
  { dimension, stride }: CloudSettings,
  viewpoint: unknown,
  positions: unknown,
  given: View,
): Query<"sees"> {
  requireLow("sees", dimension);
  const place = readViewpoint(viewpoint, dimension);
  const settings = viewSettings(given, dimension);
  const numbers = packed(readPositions(positions, stride), stride, dimension);
  const own = allocating(`${numbers.length} coordinates`, () => Float64Array.from(numbers));
  return { kind: "sees", viewpoint: place, positions: own, settings };
}

export function mapQuery(
  dimension: number,
  viewpoint: unknown,
  given: Checked<VisibilityMapOptions, typeof MAP_ROWS>,
): Query<"visibilityMap"> {
  requireSpace("visibilityMap", dimension);
  const place = readViewpoint(viewpoint, 3) as [number, number, number];
  return { kind: "visibilityMap", viewpoint: place, settings: viewSettings(given, dimension), ...mapNumbers(given) };
}

export function panoramaQuery(
  dimension: number,
  viewpoint: unknown,
  given: Checked<PanoramaOptions, typeof PANORAMA_ROWS>,
): Query<"panorama"> {
  requireSpace("panorama", dimension);
  const place = readViewpoint(viewpoint, 3);
  return { kind: "panorama", viewpoint: place, settings: viewSettings(given, dimension), ...panoramaSize(given) };
}

export function directionQuery(dimension: number, direction: unknown, given: View): Query<"visibleFromDirection"> {
  requireSpace("visibleFromDirection", dimension);
  const ahead = readViewpoint(direction, 3, "direction");
  return { kind: "visibleFromDirection", direction: ahead, settings: viewSettings(given, dimension) };
}

/** Asks for points visible from at least `k` of the viewpoints. Without `k`, from at least one. */
export function severalQuery(
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

export function radiusQuery(dimension: number, viewpoint: unknown, rule: unknown): Query<"autoRadius"> {
  return { kind: "autoRadius", viewpoint: readViewpoint(viewpoint, dimension), settings: ruleSettings(rule) };
}

export function reconstructionQuery(
  dimension: number,
  viewpoint: unknown,
  given: Checked<ReconstructionOptions, typeof MESH_ROWS>,
): Query<"reconstruct"> {
  requireSpace("reconstruct", dimension);
  const position = readViewpoint(viewpoint, dimension);
  return { kind: "reconstruct", viewpoint: position, settings: viewSettings(given, dimension), maxEdge: given.maxEdge };
}

export function illuminationQuery(
  dimension: number,
  lights: unknown,
  given: Checked<IlluminationOptions, typeof LIGHT_ROWS>,
): Query<"illuminate"> {
  requireSpace("illuminate", dimension);
  const positions = readViewpoints(lights, dimension, "lights");
  return {
    kind: "illuminate",
    lights: positions,
    settings: viewSettings(given, dimension),
    triangles: readTriangles(given.triangles),
    smoothing: given.smoothing ?? 1,
    ambient: given.ambient ?? 0,
  };
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
