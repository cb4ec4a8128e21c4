import type { Material, Points } from "three";

import { describe, HprError } from "../base/errors.js";
import { FOLLOW_OPTIONS, type FollowOptions, type FollowSettings, followSettings } from "../query/follow-options.js";
import { givenOptions, pick } from "../query/options.js";
import { VIEW_OPTIONS, viewSettings, type VisibilityOptions } from "../query/view-options.js";
import type { PatchMaterial } from "./map-material.js";

/** The options of a filter. The options of `VisibilityOptions` set how each view is computed. */
export interface HiddenPointFilterOptions extends VisibilityOptions, FollowOptions {
  /**
   * Whether answers are computed in a worker, which all filters of a page share. Until an answer
   * arrives, the option `stale` says what is drawn. With `false`, `update` computes the answer at once
   * and blocks. Default true.
   */
  worker?: boolean | undefined;
  /**
   * Hidden points are not drawn (`"hide"`, the default), or are drawn faintly (`"dim"`).
   */
  mode?: "hide" | "dim" | undefined;
  /**
   * The material of hidden points in mode `"dim"`. Default: a transparent copy of the points' own
   * material, which must then be a `PointsMaterial` (or `PointsNodeMaterial`).
   */
  dimMaterial?: Material | undefined;
  /**
   * How points with a NaN or infinite coordinate are handled: `"error"` refuses the whole cloud,
   * `"skip"` treats these points as hidden. Default `"error"`.
   */
  nonFinite?: "error" | "skip" | undefined;
}

/** {@link HiddenPointFilterOptions} with all defaults. The core checks the ranges in `view`. */
export interface FilterSettings extends FollowSettings {
  inWorker: boolean;
  /** Whether hidden points are drawn, but dimmed. */
  dim: boolean;
  dimMaterial: Material | undefined;
  nonFinite: "error" | "skip";
  /** How materials are made to leave out hidden points. Undefined where points are drawn without them. */
  patch?: PatchMaterial;
}

/** The share of its opacity that a hidden point keeps. */
export const DIMMED = 0.15;

const OWN_OPTIONS = ["worker", "mode", "dimMaterial", "nonFinite"] as const;

export function readFilterOptions(options: unknown): FilterSettings {
  const given = givenOptions(options, VIEW_OPTIONS, FOLLOW_OPTIONS, OWN_OPTIONS);
  const view = pick(given, VIEW_OPTIONS);
  viewSettings(view, 3);
  const inWorker = oneOf(given, "worker", [true, false]);
  const follow = followSettings(given, view, { isLater: inWorker, hasShaders: true });
  const dim = oneOf(given, "mode", ["hide", "dim"]) === "dim";
  if (follow.stages.some((stage) => stage.options.scores === true)) {
    throw new HprError("option", "a filter draws no scores: ask a PointCloud for them");
  }
  return {
    ...follow,
    inWorker,
    dim,
    dimMaterial: readMaterial(given["dimMaterial"], dim),
    nonFinite: oneOf(given, "nonFinite", ["error", "skip"]),
  };
}

const WAY_OUT =
  "The vertices of a mesh: new THREE.Points(mesh.geometry.clone(), material). Sprites and instances: filter a " +
  "THREE.Points with the same positions, and draw its `visible`";

/** three's own name of an object, such as "a THREE.Mesh". */
function kindOf(value: unknown): string {
  const { type } = (value ?? {}) as { type?: unknown };
  return typeof type === "string" && /^[A-Z]\w*$/.test(type) ? `a THREE.${type}` : describe(value);
}

export function requirePoints(points: unknown): asserts points is Points {
  if (typeof points !== "object" || points === null || !("isPoints" in points)) {
    throw new HprError("option", `points must be a THREE.Points, got ${kindOf(points)}. ${WAY_OUT}`);
  }
}

/** Reads an option that has one of these values. The first value is the default. */
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
  if (material === undefined) return undefined;
  if (typeof material !== "object" || material === null || !("isMaterial" in material)) {
    throw new HprError("option", `dimMaterial must be a THREE.Material, got ${describe(material)}`);
  }
  if (!dim) throw new HprError("option", `dimMaterial needs mode "dim"`);
  return material as Material;
}
