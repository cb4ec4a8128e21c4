import { describe, HprError, typeTag } from "../base/errors.js";
import { entriesOf, requireSpace } from "./options.js";
import { readEach, readViewpoint, type Viewpoint } from "./positions.js";

/** COLMAP's models of a camera. */
export type CameraModel =
  | "SIMPLE_PINHOLE"
  | "PINHOLE"
  | "SIMPLE_RADIAL"
  | "RADIAL"
  | "OPENCV"
  | "OPENCV_FISHEYE"
  | "FULL_OPENCV"
  | "FOV"
  | "SIMPLE_RADIAL_FISHEYE"
  | "RADIAL_FISHEYE"
  | "THIN_PRISM_FISHEYE";

/** How many coefficients each model has, in the order of COLMAP's numbers for them. OpenCV's own has k3 as well. */
export const CAMERA_MODELS: Readonly<Record<CameraModel, number>> = {
  SIMPLE_PINHOLE: 0,
  PINHOLE: 0,
  SIMPLE_RADIAL: 1,
  RADIAL: 2,
  OPENCV: 4,
  OPENCV_FISHEYE: 4,
  FULL_OPENCV: 8,
  FOV: 1,
  SIMPLE_RADIAL_FISHEYE: 1,
  RADIAL_FISHEYE: 2,
  THIN_PRISM_FISHEYE: 8,
};

/** The lens and the image of a camera. */
export interface Intrinsics {
  /** The focal lengths, in pixels. */
  fx: number;
  fy: number;
  /** The principal point, in pixels. */
  cx: number;
  cy: number;
  /** The size of the image, in pixels. A point is inside if 0 ≤ u < width and 0 ≤ v < height. */
  width: number;
  height: number;
  /** COLMAP's model of the lens. Default `"OPENCV"`. */
  model?: CameraModel | undefined;
  /**
   * The coefficients as COLMAP lists them for the model, behind the focal lengths and the principal point. For `"OPENCV"`
   * k1, k2, p1, p2, and k3 where there is one. Beyond the radius where the radial part stops growing, points are outside
   * of the image. Default: no distortion.
   */
  distortion?: ArrayLike<number> | undefined;
  /** The least depth along the optical axis, in the cloud's units. Default 0. */
  near?: number | undefined;
  /** The largest depth. Default `Infinity`. */
  far?: number | undefined;
}

/**
 * Where a camera is and how it is turned, by exactly one of two matrices: 16 numbers, column by column,
 * as three.js keeps them. A rotation and a translation, to within 10⁻⁵; the nearest rotation is taken.
 */
export type Pose =
  | {
      /** From the camera's space to the cloud's. */
      cameraToWorld: ArrayLike<number>;
      worldToCamera?: undefined;
    }
  | {
      cameraToWorld?: undefined;
      /** From the cloud's space to the camera's, as COLMAP and OpenCV keep it. */
      worldToCamera: ArrayLike<number>;
    };

/**
 * A pinhole camera, with the distortion of its lens if there is one. A point at x, y, z in the
 * camera's space (x to the right, y down, z forward) appears at u = fx·x/z + cx, v = fy·y/z + cy.
 * There is no shift by half a pixel: u = 0 is the left edge of the first pixel.
 */
export type ImageCamera = Intrinsics &
  Pose & {
    /**
     * The axes of the camera's space. OpenCV: y down, z forward. OpenGL (and three.js): y up, z backward.
     * Default `"opencv"`.
     */
    convention?: "opencv" | "opengl" | undefined;
  };

/** What is said of a camera whose pose was probably given the wrong way round. */
export const INVERTED =
  "next to no points are in this image, but many are in that of the inverse pose: is it cameraToWorld or worldToCamera?";

const POSES = ["cameraToWorld", "worldToCamera"] as const;
const NAMES = [
  ...POSES,
  ...(["convention", "fx", "fy", "cx", "cy", "width", "height", "model", "distortion", "near", "far"] as const),
];

/** A camera in the order in which the core reads it: see {@link readCamera}. */
export type CameraNumbers = Float64Array<ArrayBuffer>;

/** Whether a value stands for a camera, and not for a viewpoint. */
export function isCamera(value: unknown): boolean {
  const marks = [...POSES, "fx", "convention"];
  // What somebody added to Object.prototype marks no camera.
  return (
    typeof value === "object" && value !== null && marks.some((name) => name in value && !(name in Object.prototype))
  );
}

/** The camera in the order in which the core reads it (`Camera::of`). The core checks the ranges. */
export function readCamera(camera: unknown, whose = "camera"): CameraNumbers {
  const given = named(camera, whose);
  const { convention = "opencv" } = given;
  if (convention !== "opencv" && convention !== "opengl") {
    throw new HprError("option", `the ${whose}'s convention must be "opencv" or "opengl", got ${describe(convention)}`);
  }
  const [pose, other] = POSES.filter((name) => given[name] !== undefined);
  if (pose === undefined || other !== undefined) {
    const got = pose === undefined ? "neither" : "both";
    throw new HprError("viewpoint", `the ${whose} needs exactly one of cameraToWorld and worldToCamera, got ${got}`);
  }
  const matrix = numbers(whose, pose, given[pose], 16);
  const number = (name: (typeof NAMES)[number], usual?: number) => {
    const value = given[name] ?? usual;
    if (typeof value !== "number") {
      throw new HprError("viewpoint", `the ${whose}'s ${name} must be a number, got ${describe(value)}`);
    }
    return value;
  };
  const models = Object.keys(CAMERA_MODELS);
  const { model = "OPENCV" } = given;
  if (typeof model !== "string" || !models.includes(model)) {
    throw new HprError("option", `the ${whose}'s model must be one of ${models.join(", ")}, got ${describe(model)}`);
  }
  return Float64Array.of(
    ...matrix,
    ...(["fx", "fy", "cx", "cy", "width", "height"] as const).map((name) => number(name)),
    ...coefficients(whose, model as CameraModel, given["distortion"]),
    number("near", 0),
    number("far", Infinity),
    convention === "opengl" ? 1 : 0,
    models.indexOf(model),
    pose === "worldToCamera" ? 1 : 0,
  );
}

/** The coefficients of a distortion, and zeros. */
function coefficients(whose: string, model: CameraModel, given: unknown): number[] {
  const count = CAMERA_MODELS[model];
  const hasK3 = model === "OPENCV" && (given as Partial<ArrayLike<unknown>> | undefined)?.length === 5;
  const own = given === undefined ? [] : numbers(whose, `distortion for ${model}`, given, hasK3 ? 5 : count);
  return Array.from({ length: 8 }, (_, i) => own[i] ?? 0);
}

function named(camera: unknown, whose: string): Record<string, unknown> {
  if (typeTag(camera) !== "Object") {
    throw new HprError("viewpoint", `the ${whose} must be an object, got ${describe(camera)}`);
  }
  return entriesOf(whose, camera, NAMES);
}

function numbers(whose: string, name: string, list: unknown, count: number): number[] {
  const length = typeof list === "object" && list !== null && "length" in list ? list.length : undefined;
  const values = length === count ? Array.from(list as ArrayLike<unknown>) : [];
  if (length !== count || !values.every((value) => typeof value === "number")) {
    const got = length === undefined || length === count ? describe(list) : `${describe(length)} of them`;
    throw new HprError("viewpoint", `the ${whose}'s ${name} must be ${count} numbers, got ${got}`);
  }
  return values;
}

/** From where a cloud is seen: by an eye that looks everywhere, or by a camera, which sees only what is in its image. */
export type Seat = number[] | CameraNumbers;

/** A viewpoint, or a camera in its place. */
export type ViewpointOrCamera = Viewpoint | ImageCamera;

/** Several viewpoints, or cameras in their place. An error says which one it is about. */
export function readSeats(list: unknown, dimension: number, name: string): Seat[] {
  return readEach(list, name, `${dimension} numbers each`, (given, which) => {
    if (!isCamera(given)) return readViewpoint(given, dimension, `viewpoint ${which}`);
    requireSpace("a camera", dimension);
    return readCamera(given, `camera ${which}`);
  });
}

/** Several cameras, for a question that needs their images. */
export function readCameras(list: unknown): CameraNumbers[] {
  return readEach(list, "cameras", "cameras", (given, which) => readCamera(given, `camera ${which}`));
}

export function isCameraSeat(seat: Seat): seat is CameraNumbers {
  return seat instanceof Float64Array;
}
