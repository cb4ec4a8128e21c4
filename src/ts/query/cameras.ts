import { describe, HprError } from "../base/errors.js";
import type { Intrinsics } from "./camera.js";
import type { Viewpoint } from "./positions.js";

/** An {@link ImageCamera} whose pose is from the camera's space to the cloud's. */
export type PosedCamera = Intrinsics & { cameraToWorld: ArrayLike<number>; convention: "opencv" | "opengl" };

/**
 * A camera from its pose: its place and its orientation in the cloud's space. The quaternion x, y, z, w
 * turns the camera's axes into the cloud's. It need not have length 1.
 *
 * @throws HprError `viewpoint` for a pose that is not of numbers, or a quaternion of length 0.
 */
export function cameraFromPose(
  position: Viewpoint,
  quaternion: ArrayLike<number> | { readonly x: number; readonly y: number; readonly z: number; readonly w: number },
  intrinsics: Intrinsics,
  convention: "opencv" | "opengl" = "opencv",
): PosedCamera {
  const place = list("position", position, 3);
  const turn = list("quaternion", quaternion, 4);
  const length = Math.hypot(...turn);
  if (!(length > 0 && length < Infinity)) {
    throw new HprError("viewpoint", `the camera's quaternion must be finite and not zero, got ${turn.join(", ")}`);
  }
  const [x, y, z, w] = turn.map((number) => number / length) as [number, number, number, number];
  const cameraToWorld = [
    ...[1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0],
    ...[2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0],
    ...[2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0],
    ...place,
    1,
  ];
  return { ...intrinsics, cameraToWorld, convention };
}

/**
 * The lens of a camera with a field of view, without distortion. Pixels are square, and the principal
 * point is the middle of the image.
 *
 * @param degrees the field of view from the upper to the lower border, in degrees, as three.js counts
 *   it: above 0 and below 180.
 * @throws HprError `viewpoint` for a field of view or a size that is out of range.
 */
export function intrinsicsFromFieldOfView(degrees: number, width: number, height: number): Intrinsics {
  if (typeof degrees !== "number" || !(degrees > 0 && degrees < 180)) {
    throw new HprError(
      "viewpoint",
      `the field of view must be above 0 and below 180 degrees, got ${describe(degrees)}`,
    );
  }
  checkSize(width, height);
  const focal = height / 2 / Math.tan((degrees * Math.PI) / 360);
  return { fx: focal, fy: focal, cx: width / 2, cy: height / 2, width, height };
}

/** What is read of three's `PerspectiveCamera`. */
export interface PerspectiveCameraLike {
  readonly isPerspectiveCamera?: boolean;
  readonly matrixWorld: { readonly elements: ArrayLike<number> };
  readonly projectionMatrix: { readonly elements: ArrayLike<number> };
  readonly near: number;
  readonly far: number;
  /** three's own method. It brings `matrixWorld` up to date. */
  updateWorldMatrix?(updateParents: boolean, updateChildren: boolean): void;
}

/**
 * A camera from a `PerspectiveCamera` of three.js. Zoom, view offset and film offset count. The cloud is
 * in world coordinates. `width` and `height` are the size of the image in pixels.
 *
 * @throws HprError `viewpoint` for another kind of camera, or a size that is out of range.
 */
export function cameraFromThree(camera: PerspectiveCameraLike, width: number, height: number): PosedCamera {
  if ((camera as Partial<PerspectiveCameraLike> | undefined)?.isPerspectiveCamera !== true) {
    throw new HprError(
      "viewpoint",
      `the camera must be a PerspectiveCamera (for others, see visibleFromDirection), got ${describe(camera)}`,
    );
  }
  checkSize(width, height);
  camera.updateWorldMatrix?.(true, false);
  const elements = (name: "projectionMatrix" | "matrixWorld") =>
    list(name, (camera as Partial<PerspectiveCameraLike>)[name]?.elements, 16);
  const projection = elements("projectionMatrix");
  return {
    cameraToWorld: elements("matrixWorld"),
    convention: "opengl",
    fx: (projection[0]! * width) / 2,
    fy: (projection[5]! * height) / 2,
    cx: ((1 - projection[8]!) * width) / 2,
    cy: ((1 + projection[9]!) * height) / 2,
    width,
    height,
    near: camera.near,
    far: camera.far,
  };
}

function checkSize(width: number, height: number): void {
  for (const [name, size] of Object.entries({ width, height })) {
    if (typeof size !== "number" || !(size > 0 && size < Infinity)) {
      throw new HprError("viewpoint", `the camera's ${name} must be finite and positive, got ${describe(size)}`);
    }
  }
}

/** So many numbers: a list, or the x, y, z and w of a vector or a quaternion, which may have a method `length`. */
function list(name: string, given: unknown, count: number): number[] {
  const own = Object(given) as Record<string | number, unknown>;
  const isVector = typeof own["length"] !== "number";
  const numbers = Array.from({ length: count }, (_, i) => own[isVector ? "xyzw"[i]! : i]);
  if (!(isVector || own["length"] === count) || !numbers.every((value) => typeof value === "number")) {
    throw new HprError("viewpoint", `the camera's ${name} must be ${count} numbers, got ${describe(given)}`);
  }
  return numbers;
}
