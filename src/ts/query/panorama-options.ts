import { HprError } from "../base/errors.js";
import type { PANORAMA_ROWS, PanoramaOptions } from "./option-rows.js";
import type { Checked } from "./options.js";
import { readViewpoint } from "./positions.js";

export type { PanoramaOptions };

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

export interface PanoramaSize {
  width: number;
  height: number;
  up: number[];
}

export function panoramaSize(given: Checked<PanoramaOptions, typeof PANORAMA_ROWS>): PanoramaSize {
  const { width, height, up = [0, 0, 1] } = given;
  for (const [name, size] of Object.entries({ width, height }) as [string, number | undefined][]) {
    if (size === undefined) {
      throw new HprError("option", `${name} must be given: an integer from 1 to 16384`);
    }
  }
  return { width, height, up: readViewpoint(up, 3, "direction") };
}
