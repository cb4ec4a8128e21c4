import type { Material, Points } from "three";

import { describe, HprError } from "../base/errors.js";
import {
  FOLLOW_OPTIONS,
  type FollowedOptions,
  type FollowOptions,
  type FollowSettings,
  followSettings,
} from "../follow/options.js";
import { PointCloud } from "../cloud/cloud.js";
import { givenOptions, pick } from "../query/options.js";
import { readViewpoint, type Viewpoint } from "../query/positions.js";
import { VIEW_OPTIONS } from "../query/view-options.js";
import { WorkerPointCloud } from "../worker/client.js";
import type { Cloud } from "../worker/followed-cloud.js";
import type { PatchMaterial } from "./map-material.js";

/** The options of a filter. The options of `VisibilityOptions` set how each view is computed. */
export type HiddenPointFilterOptions = FollowedOptions &
  FollowOptions & {
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
    /**
     * A cloud of the same points in the same order, which the filter asks instead of a cloud of its own. It is not
     * disposed of with the filter. `worker` and `nonFinite` are then those of the cloud. A function makes such a cloud,
     * and makes it again when its worker is lost. The filter disposes of it.
     */
    cloud?: PointCloud | WorkerPointCloud | (() => Promise<WorkerPointCloud>) | undefined;
    /**
     * Where the zero of the points' space is in `cloud`: x, y, z in double precision. So a cloud keeps the coordinates of
     * a map, and the points are drawn in single precision around their own zero. Default 0, 0, 0.
     */
    origin?: Viewpoint | undefined;
  };

/** What is asked: options of a view, and those of the view at rest. */
export type AskedOptions = FollowedOptions & Pick<FollowOptions, "settle">;

/** {@link HiddenPointFilterOptions} with all defaults. The core checks the ranges in `view`. */
export interface FilterSettings extends FollowSettings {
  /** The options as they were given. */
  given: HiddenPointFilterOptions;
  inWorker: boolean;
  /** Whether hidden points are drawn, but dimmed. */
  dim: boolean;
  dimMaterial: Material | undefined;
  nonFinite: "error" | "skip";
  /** A cloud of the same points, or what makes it. Undefined: the filter makes one. */
  cloud: Cloud | (() => Promise<WorkerPointCloud>) | undefined;
  origin: readonly number[] | undefined;
  /** How materials are made to leave out hidden points. Undefined where points are drawn without them. */
  patch?: PatchMaterial;
}

/** The share of its opacity that a hidden point keeps. */
export const DIMMED = 0.15;

const OWN_OPTIONS = ["worker", "mode", "dimMaterial", "nonFinite"] as const;

/** `others` are the names of options that this filter alone has. */
export function readFilterOptions(options: unknown, others: readonly string[] = []): FilterSettings {
  const given = givenOptions(options, VIEW_OPTIONS, FOLLOW_OPTIONS, OWN_OPTIONS, others);
  const cloud = readCloud(given["cloud"]);
  const { origin } = given;
  if (origin !== undefined && cloud === undefined) {
    throw new HprError("option", "origin needs the option cloud: it is a place in that cloud");
  }
  const inWorker = oneOf(given, "worker", [true, false]) && !(cloud instanceof PointCloud);
  const follow = followSettings(given, { isLater: inWorker, hasShaders: true });
  if (follow.stages.some((stage) => stage.options.scores === true)) {
    throw new HprError("option", "a filter draws no scores: ask a PointCloud for them");
  }
  return {
    ...follow,
    given,
    inWorker,
    dim: oneOf(given, "mode", ["hide", "dim"]) === "dim",
    dimMaterial: readMaterial(given["dimMaterial"]),
    nonFinite: oneOf(given, "nonFinite", ["error", "skip"]),
    cloud,
    origin: origin === undefined ? undefined : readViewpoint(origin, 3, "origin"),
  };
}

/** The options that are properties of a filter, and those that each of them excludes. */
const EXCLUDED = {
  looks: ["radius", "exponent", "inversion"],
  exponent: ["radius", "inversion", "looks", "thickness", "surface"],
  thickness: [],
  surface: [],
} as const satisfies Record<string, readonly string[]>;

/** The options that are asked with, after one has changed. Others that it excludes are dropped. */
export function withOption({ given }: FilterSettings, name: keyof typeof EXCLUDED, value: unknown): AskedOptions {
  const dropped: readonly string[] = value === undefined ? [] : EXCLUDED[name];
  const kept = [...VIEW_OPTIONS, "settle"].filter((other) => !dropped.includes(other));
  return { ...pick({ ...given }, kept), [name]: value };
}

/**
 * The settings with these options of a view and `settle` in place of those before.
 *
 * @throws HprError `option`.
 */
export function changedSettings(
  { given }: FilterSettings,
  options: AskedOptions,
  others: readonly string[],
): FilterSettings {
  const asked = givenOptions(options, VIEW_OPTIONS, ["settle"]);
  const own = pick({ ...given }, ["stale", ...OWN_OPTIONS, ...others]);
  return readFilterOptions({ ...own, ...asked }, others);
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
export function oneOf<T extends string | boolean>(
  given: Readonly<Record<string, unknown>>,
  name: string,
  values: readonly [T, T],
): T {
  const value = given[name] ?? values[0];
  if (!values.includes(value as T)) {
    throw new HprError(
      "option",
      `${name} must be ${values.map((one) => JSON.stringify(one)).join(" or ")}, got ${describe(value)}`,
    );
  }
  return value as T;
}

function readMaterial(material: unknown): Material | undefined {
  if (material === undefined) return undefined;
  if (typeof material !== "object" || material === null || !("isMaterial" in material)) {
    throw new HprError("option", `dimMaterial must be a THREE.Material, got ${describe(material)}`);
  }
  return material as Material;
}

function readCloud(cloud: unknown): FilterSettings["cloud"] {
  const isMaker = typeof cloud === "function";
  return cloud === undefined || isMaker ? (cloud as FilterSettings["cloud"]) : requireCloud(cloud);
}

/** The option `cloud`, or what it makes. */
export function requireCloud(cloud: unknown): Cloud {
  if (cloud instanceof PointCloud || cloud instanceof WorkerPointCloud) return cloud;
  throw new HprError(
    "option",
    `cloud must be a PointCloud, a WorkerPointCloud or a function that makes one, got ${describe(cloud)}`,
  );
}
