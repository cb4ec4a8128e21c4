import type { Material, Points } from "three";

import { describe, HprError } from "../base/errors.js";
import { givenOptions, pick } from "../query/options.js";
import { VIEW_OPTIONS, viewSettings, type VisibilityOptions } from "../query/view-options.js";

/** How points are filtered: how each view is computed, and the following. */
export interface HiddenPointFilterOptions extends VisibilityOptions {
  /**
   * Whether answers are computed in a worker, which all filters of a page share; what is
   * drawn stays as it was until they are there. Otherwise `update` computes them at once,
   * and blocks. Default true.
   */
  worker?: boolean | undefined;
  /** Hidden points are not drawn at all (`"hide"`, the default), or faintly (`"dim"`). */
  mode?: "hide" | "dim" | undefined;
  /**
   * What hidden points are drawn with in mode `"dim"`. Default: a transparent copy of the
   * points' own material, which must be a `PointsMaterial` (or `PointsNodeMaterial`) then.
   */
  dimMaterial?: Material | undefined;
  /**
   * What becomes of points with a NaN or infinite coordinate: `"error"` refuses them all,
   * `"skip"` takes them for hidden. Default `"error"`.
   */
  nonFinite?: "error" | "skip" | undefined;
}

/** {@link HiddenPointFilterOptions}, complete; the ranges of `view` are the core's to check. */
export interface FilterSettings {
  view: VisibilityOptions;
  inWorker: boolean;
  dim: boolean;
  dimMaterial: Material | undefined;
  nonFinite: "error" | "skip";
}

export function readFilterOptions(options: unknown): FilterSettings {
  const given = givenOptions(options, VIEW_OPTIONS, ["worker", "mode", "dimMaterial", "nonFinite"]);
  const view = pick(given, VIEW_OPTIONS);
  viewSettings(view, 3);
  const dim = oneOf(given, "mode", ["hide", "dim"]) === "dim";
  return {
    view,
    inWorker: oneOf(given, "worker", [true, false]),
    dim,
    dimMaterial: readMaterial(given["dimMaterial"], dim),
    nonFinite: oneOf(given, "nonFinite", ["error", "skip"]),
  };
}

export function requirePoints(points: unknown): asserts points is Points {
  if (typeof points !== "object" || points === null || !("isPoints" in points)) {
    throw new HprError("option", `points must be a THREE.Points, got ${describe(points)}`);
  }
}

/** One of several values, the first by default. */
function oneOf<T extends string | boolean>(given: Record<string, unknown>, name: string, values: readonly [T, T]): T {
  const value = given[name] ?? values[0];
  if (!values.includes(value as T)) {
    throw new HprError(
      "option",
      `${name} must be ${values.map((one) => JSON.stringify(one)).join(" or ")}, got ${describe(value)}`,
    );
  }
  return value as T;
}

function readMaterial(material: unknown, dim: boolean): Material | undefined {
  if (material === undefined) {
    return undefined;
  }
  if (typeof material !== "object" || material === null || !("isMaterial" in material)) {
    throw new HprError("option", `dimMaterial must be a THREE.Material, got ${describe(material)}`);
  }
  if (!dim) {
    throw new HprError("option", `dimMaterial needs mode "dim"`);
  }
  return material as Material;
}
