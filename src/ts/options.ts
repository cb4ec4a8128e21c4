import { describe, HprError, typeTag } from "./errors.js";

/** How a cloud's positions are to be read. */
export interface PointCloudOptions {
  /** Coordinates of a point; 3 is the only dimension supported. Default 3. */
  dimension?: number | undefined;
  /**
   * Numbers from the start of one point to the start of the next, at least 3;
   * the first three are x, y and z, the others are skipped. Default 3.
   */
  stride?: number | undefined;
  /**
   * What becomes of points with a NaN or infinite coordinate: `"error"` refuses
   * the cloud, `"skip"` keeps their indices, but they are never visible and hide
   * nothing. Default `"error"`.
   */
  nonFinite?: "error" | "skip" | undefined;
}

/**
 * How one view is computed. At most one of `radius` and `exponent` may be given.
 */
export interface VisibilityOptions {
  /**
   * R, the radius of the sphere that points are flipped about (paper, §3.1,
   * eq. 1), in the cloud's units: finite, and at least the distance of the
   * farthest point. `"auto"`, the default, derives it from the cloud's spacing
   * and the viewpoint.
   */
  radius?: number | "auto" | undefined;
  /** R = farthest distance · 10^exponent, the paper's own parameter; at least 0. */
  exponent?: number | undefined;
  /** The kernel that flips the points; spherical flipping is the only one supported. */
  inversion?: "spherical" | undefined;
}

/** Options of a cloud, checked and complete. */
export interface CloudSettings {
  stride: number;
  skipNonFinite: boolean;
}

/**
 * Options of a view, checked; neither field means the automatic radius. Both are
 * always there, or the core would look for them in `Object.prototype`.
 */
export interface ViewSettings {
  radius: number | undefined;
  exponent: number | undefined;
}

export const CLOUD_OPTIONS = ["dimension", "stride", "nonFinite"] as const;
export const VIEW_OPTIONS = ["radius", "exponent", "inversion"] as const;

/** A greater one would not fit into the core's memory. */
const MAX_STRIDE = 2 ** 32 - 1;

/**
 * The options that were really given, those that are `undefined` left out.
 * Refuses what is in none of the groups of names. Has no prototype, so that
 * nothing but what was given can be read from it.
 */
export function givenOptions(
  options: unknown,
  ...groups: readonly (readonly string[])[]
): Record<string, unknown> {
  const given = Object.create(null) as Record<string, unknown>;
  if (options === undefined) {
    return given;
  }
  // The tag refuses arrays, maps, promises and the like, whose contents would be ignored.
  if (typeof options !== "object" || options === null || typeTag(options) !== "Object") {
    throw new HprError("option", `the options must be a plain object, got ${describe(options)}`);
  }
  const known = groups.flat();
  for (const name of namesIn(options, known)) {
    const value: unknown = Reflect.get(options, name);
    if (value === undefined) {
      continue;
    }
    if (typeof name === "symbol" || !known.includes(name)) {
      throw new HprError("option", `unknown option ${describe(name)}; known are ${known.join(", ")}`);
    }
    given[name] = value;
  }
  return given;
}

/**
 * What an object and its prototypes define: the known names, and whatever else
 * can be enumerated. Not what `Object.prototype` defines, which every object
 * inherits and no caller means.
 */
function namesIn(options: object, known: readonly string[]): Set<string | symbol> {
  const names = new Set<string | symbol>();
  let level: object | null = options;
  while (level !== null) {
    const next = Object.getPrototypeOf(level) as object | null;
    // That of another frame, too.
    if (next === null && Object.hasOwn(level, "isPrototypeOf")) {
      break;
    }
    for (const name of Reflect.ownKeys(level)) {
      const isKnown = typeof name === "string" && known.includes(name);
      if (isKnown || Object.prototype.propertyIsEnumerable.call(level, name)) {
        names.add(name);
      }
    }
    level = next;
  }
  return names;
}

/** Those of the given options that are in one group of names. */
export function pick(
  given: Record<string, unknown>,
  names: readonly string[],
): Record<string, unknown> {
  const picked = Object.create(null) as Record<string, unknown>;
  for (const name of names) {
    picked[name] = given[name];
  }
  return picked;
}

export function cloudSettings(given: Record<string, unknown>): CloudSettings {
  const { dimension = 3, stride = 3, nonFinite = "error" } = given;
  if (dimension !== 3) {
    throw new HprError("option", `dimension must be 3, the only one supported, got ${describe(dimension)}`);
  }
  if (!isStride(stride)) {
    throw new HprError("option", `stride must be an integer from 3 to ${MAX_STRIDE}, got ${describe(stride)}`);
  }
  if (nonFinite !== "error" && nonFinite !== "skip") {
    throw new HprError("option", `nonFinite must be "error" or "skip", got ${describe(nonFinite)}`);
  }
  return { stride, skipNonFinite: nonFinite === "skip" };
}

/** Types only: ranges are the core's to check, which knows the distances. */
export function viewSettings(given: Record<string, unknown>): ViewSettings {
  const { radius, exponent, inversion = "spherical" } = given;
  if (radius !== undefined && exponent !== undefined) {
    throw new HprError("option", "radius and exponent exclude each other; give one of the two");
  }
  if (inversion !== "spherical") {
    throw new HprError(
      "option",
      `inversion must be "spherical", the only one supported, got ${describe(inversion)}`,
    );
  }
  if (typeof exponent === "number") {
    return { radius: undefined, exponent };
  }
  if (exponent !== undefined) {
    throw new HprError("option", `exponent must be a number, got ${describe(exponent)}`);
  }
  if (typeof radius === "number") {
    return { radius, exponent: undefined };
  }
  if (radius !== undefined && radius !== "auto") {
    throw new HprError("option", `radius must be a number or "auto", got ${describe(radius)}`);
  }
  return { radius: undefined, exponent: undefined };
}

/** The rule of `autoRadius`. */
export function checkRule(rule: unknown): void {
  if (rule !== undefined && rule !== "auto") {
    throw new HprError("option", `the rule must be "auto", the only one supported, got ${describe(rule)}`);
  }
}

function isStride(value: unknown): value is number {
  return Number.isInteger(value) && (value as number) >= 3 && (value as number) <= MAX_STRIDE;
}
