import { describe, HprError, typeTag } from "../base/errors.js";
import { type Camera, type CameraNumbers, isCamera, readCamera } from "./camera.js";
import { entriesOf, integer, number } from "./options.js";
import { MOST_POINTS, readViewpoint, type Viewpoint } from "./positions.js";
import { VIEW_OPTIONS, type VisibilityOptions } from "./view-options.js";

/** A cone of directions. */
export interface Cone {
  /** x, y, z of its axis, of any length but 0. */
  direction: Viewpoint;
  /** Its full opening in degrees, above 0 and at most 360. */
  angle: number;
}

/**
 * How a map of directions is made. `scores` and `radius: "opposite"` are refused.
 */
export interface VisibilityMapOptions extends VisibilityOptions {
  /** How many points the map's hull has at most: an integer of at least 16. Default 32,768. */
  points?: number | undefined;
  /** How many directions the map has at most: an integer from 64 to 4,194,304. Default 131,072. */
  corners?: number | undefined;
  /** The only directions that get points and corners: those of a camera, or a cone. Default: all. */
  towards?: Camera | Cone | undefined;
  /**
   * x, y, z of the place that positions in a shader are relative to. Default: 0 for a cloud of a Float32Array, and
   * the middle of the cloud's box for others.
   */
  origin?: Viewpoint | undefined;
}

export const MAP_OPTIONS = [...VIEW_OPTIONS, "points", "corners", "towards", "origin"] as const;

/** How a map is made, as the core reads it. */
export interface MapNumbers {
  /** The choices in the order of src/wasm/maps.rs. */
  map: Float64Array<ArrayBuffer>;
  /** The camera of `towards`, of which the core makes the cone. */
  camera?: CameraNumbers | undefined;
}

export function mapNumbers(given: Record<string, unknown>): MapNumbers {
  const points = integer(given, "points", 16, MOST_POINTS) ?? 0;
  const corners = integer(given, "corners", 64, 4_194_304) ?? 0;
  const { towards, origin } = given;
  const camera = isCamera(towards) ? readCamera(towards) : undefined;
  const cone = camera || towards === undefined ? [0, 0, 0, 0] : readCone(towards);
  const place = origin === undefined ? [Infinity, 0, 0] : readViewpoint(origin, 3, "origin");
  return { map: Float64Array.of(points, corners, ...cone, ...place), camera };
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
