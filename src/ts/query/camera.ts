import { describe, HprError } from "../base/errors.js";
import { givenOptions } from "./options.js";

/**
 * A pinhole camera, with the distortion of its lens if there is one. A point at x, y, z in the
 * camera's space (x to the right, y down, z forward) appears at u = fx·x/z + cx, v = fy·y/z + cy.
 * There is no shift by half a pixel.
 */
export interface Camera {
  /**
   * From the camera's space to the cloud's: 16 numbers, column by column, as three.js keeps them. A
   * rotation and a translation, to within 10⁻⁵.
   */
  matrix: ArrayLike<number>;
  /** The axes of the camera's space. OpenCV: y down, z forward. OpenGL (and three.js): y up, z backward. */
  convention: "opencv" | "opengl";
  /** The focal lengths, in pixels. */
  fx: number;
  fy: number;
  /** The principal point, in pixels. */
  cx: number;
  cy: number;
  /** The size of the image, in pixels. A point is inside if 0 ≤ u < width and 0 ≤ v < height. */
  width: number;
  height: number;
  /**
   * OpenCV's coefficients k1, k2, p1, p2, k3. Beyond the radius where the radial part stops growing,
   * points are outside of the image. Default: no distortion.
   */
  distortion?: ArrayLike<number> | undefined;
  /** The least depth along the optical axis, in the cloud's units. Default 0. */
  near?: number | undefined;
  /** The largest depth. Default `Infinity`. */
  far?: number | undefined;
}

const NAMES = ["matrix", "convention", "fx", "fy", "cx", "cy", "width", "height", "distortion", "near", "far"] as const;

/** The camera in the order in which the core reads it (src/wasm/views.rs). The core checks the ranges. */
export function readCamera(camera: unknown): Float64Array<ArrayBuffer> {
  const given = named(camera);
  const { convention } = given;
  if (convention !== "opencv" && convention !== "opengl") {
    throw new HprError("option", `the camera's convention must be "opencv" or "opengl", got ${describe(convention)}`);
  }
  const number = (name: (typeof NAMES)[number], usual?: number) => {
    const value = given[name] ?? usual;
    if (typeof value !== "number") {
      throw new HprError("viewpoint", `the camera's ${name} must be a number, got ${describe(value)}`);
    }
    return value;
  };
  return Float64Array.of(
    ...numbers("matrix", given["matrix"], 16),
    ...(["fx", "fy", "cx", "cy", "width", "height"] as const).map((name) => number(name)),
    ...numbers("distortion", given["distortion"] ?? [0, 0, 0, 0, 0], 5),
    number("near", 0),
    number("far", Infinity),
    convention === "opengl" ? 1 : 0,
  );
}

function named(camera: unknown): Record<string, unknown> {
  if (typeof camera !== "object" || camera === null) {
    throw new HprError("viewpoint", `the camera must be an object, got ${describe(camera)}`);
  }
  try {
    return givenOptions(camera, NAMES);
  } catch (cause) {
    throw cause instanceof HprError ? new HprError(cause.code, `camera: ${cause.message}`, { cause }) : cause;
  }
}

function numbers(name: string, list: unknown, count: number): number[] {
  const length = typeof list === "object" && list !== null && "length" in list ? list.length : undefined;
  const values = length === count ? Array.from(list as ArrayLike<unknown>) : [];
  if (values.length !== count || !values.every((value) => typeof value === "number")) {
    const got = length === undefined || length === count ? describe(list) : `${describe(length)} of them`;
    throw new HprError("viewpoint", `the camera's ${name} must be ${count} numbers, got ${got}`);
  }
  return values;
}
