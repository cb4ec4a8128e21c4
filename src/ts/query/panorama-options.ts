import { HprError } from "../base/errors.js";
import { integer } from "./options.js";
import { readViewpoint, type Viewpoint } from "./positions.js";
import { VIEW_OPTIONS, type VisibilityOptions } from "./view-options.js";

/** The size of a panorama. `scores` is refused. */
export interface PanoramaOptions extends VisibilityOptions {
  /** The number of columns: an integer from 1 to 16,384. */
  width: number;
  /** The number of rows: an integer from 1 to 16,384. */
  height: number;
  /**
   * x, y, z of the direction above the first row, of any length but 0. Column 0 looks along the part of +x
   * that is perpendicular to it, or of +y where +x is parallel to it. Default `[0, 0, 1]`.
   */
  up?: Viewpoint | undefined;
}

/** What stands in each direction around a viewpoint, row after row from up to down. */
export interface Panorama {
  /** The distance to the surface in each direction, in the cloud's units; `Infinity` for the sky. */
  ranges: Float32Array;
  /** The visible point that is nearest by angle; 2³² − 1 for the sky. */
  indices: Uint32Array;
  /** The share of the sky in the upper half of the sphere, weighted by the cosine from up: 0 to 1. */
  skyViewFactor: number;
  /** How much of the sphere is surface, in steradians. */
  solidAngle: number;
}

export const PANORAMA_OPTIONS = [...VIEW_OPTIONS, "width", "height", "up"] as const;

const MOST = 16_384;

export interface PanoramaSize {
  width: number;
  height: number;
  up: number[];
}

export function panoramaSize(given: Record<string, unknown>): PanoramaSize {
  const { up = [0, 0, 1] } = given;
  return { width: size(given, "width"), height: size(given, "height"), up: readViewpoint(up, 3, "direction") };
}

function size(given: Record<string, unknown>, name: string): number {
  const size = integer(given, name, 1, MOST);
  if (size === undefined) {
    throw new HprError("option", `${name} must be given: an integer from 1 to ${MOST}`);
  }
  return size;
}
