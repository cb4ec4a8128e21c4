import { describe, HprError, typeTag } from "../base/errors.js";
import { type CameraNumbers, isCamera, readCamera } from "./camera.js";
import type { MAP_ROWS, VisibilityMapOptions } from "./option-rows.js";
import type { Cone } from "./option-types.js";
import { type Checked, entriesOf, number } from "./options.js";
import { readViewpoint } from "./positions.js";

export type { Cone, VisibilityMapOptions };

/** How a map is made, as the core reads it. */
export interface MapNumbers {
  /** The choices in the order of src/wasm/outputs.rs. */
  map: Float64Array<ArrayBuffer>;
  /** The camera of `towards`, of which the core makes the cone. */
  camera?: CameraNumbers | undefined;
}

export function mapNumbers(given: Checked<VisibilityMapOptions, typeof MAP_ROWS>): MapNumbers {
  const { points = 0, towards, origin } = given;
  const camera = isCamera(towards) ? readCamera(towards) : undefined;
  const cone = camera || towards === undefined ? [0, 0, 0, 0] : readCone(towards);
  const place = origin === undefined ? [Infinity, 0, 0] : readViewpoint(origin, 3, "origin");
  return { map: Float64Array.of(points, ...cone, ...place), camera };
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
