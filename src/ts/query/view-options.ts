import { describe, HprError } from "../base/errors.js";
import { entriesOf, flag, integer, number } from "./options.js";
import { ALL_POINTS, type Within, type WithinSettings, withinSettings } from "./within.js";

/** How the radius R is chosen if it is not given. */
export type RadiusRule = "auto" | "opposite";

/**
 * How points are flipped (paper, §3). A point at distance d from the viewpoint moves to the distance
 *
 * - 2R − d with `"spherical"`;
 * - d·(d/S)^−γ with `{ power: γ }`, where 1 < γ ≤ 16. S is `radius` if it is given, otherwise the
 *   farthest distance. S affects only the rounding;
 * - exp(c/d) with `{ exponential: c }`, where c is positive and in the cloud's units. With `"auto"`,
 *   c is 0.07 of the cloud's spacing.
 */
export type Inversion = "spherical" | { power: number } | { exponential: number | "auto" };

/**
 * The inversion of an answer, with numbers only. With `looks`, it holds the c of each look.
 * This last form is not accepted as an option: use the option `looks` for it.
 */
export type ResolvedInversion =
  | "spherical"
  | { readonly power: number }
  | { readonly exponential: number }
  // From tight to loose.
  | { readonly looks: readonly number[] };

/**
 * How one view is computed. At most one of `radius` and `exponent` may be given. With an inversion by
 * `power`, `radius` may be a number, but `exponent` is not allowed. With `exponential`, neither of the
 * two is allowed. `looks` excludes `radius`, `exponent` and `inversion`.
 */
export interface VisibilityOptions {
  /**
   * R, the radius of the sphere that points are flipped about (paper, §3.1, eq. 1), in the cloud's
   * units. It is finite, and at least the distance of the farthest point. Instead of a number, this
   * can be the rule that chooses R:
   *
   * - `"auto"`, the default, is R = 0.4·n^¼·r²/g, from the viewpoint, the number of points and the gaps
   *   between them (`docs/VISIBLE.md`).
   * - `"opposite"` is the paper's own rule (§4), which takes about 40 hulls. In perspective, its R is
   *   mostly far too large.
   */
  radius?: number | RadiusRule | undefined;
  /**
   * R = farthest distance · 10^exponent, the paper's own parameter. It is at least 0. Large values such as 99 are
   * legal but useless: nearly every point counts as visible then.
   */
  exponent?: number | undefined;
  /** How points are flipped. Default `"spherical"`. */
  inversion?: Inversion | ResolvedInversion | undefined;
  /**
   * Uses two or three looks instead of one flip. Each look is an exact hull of exp(c/d), and decides
   * only the points that it is sure of. The scale c goes from large to small, in units of the cloud's
   * spacing. The answer is truer around silhouettes and if the sampling is uneven, but takes about
   * three times as long. It is no longer the operator of the paper: several points on one ray may be
   * visible, not only the nearest, and parts cannot be merged. Needs a cloud of dimension 3.
   */
  looks?: 2 | 3 | undefined;
  /**
   * Only with `looks`: how far behind the surface before it a point may lie and still be seen, in the
   * cloud's units; at least 0. A measured surface is as thick as its noise, and scans that were put
   * together lie beside each other. With `"auto"`, the default, it follows from the cloud's `noise`. If
   * the noise is the same everywhere, it is removed before the view instead. With 0, neither happens
   * (`docs/LOOKS.md`).
   */
  thickness?: number | "auto" | undefined;
  /** Only with `looks`: the answer also has `scores`, which say how sure it is. For one viewpoint only. */
  scores?: boolean | undefined;
  /**
   * Only these points take part. The answer is the same as for a cloud of only these points, with that
   * cloud's spacing and farthest distance. This choice comes before all other options. If there are
   * several viewpoints or lights, `distance` gives each of them its own points. A direction allows no
   * `distance`. Needs a cloud of dimension 2 or 3.
   */
  within?: Within | undefined;
}

/** {@link VisibilityOptions}, checked for type, as the core reads them (src/wasm/options.rs). */
export interface ViewSettings extends WithinSettings {
  /** A number of {@link Rule}. */
  rule: number;
  /** R or the exponent, if one is given. */
  size: number;
  /** A number of {@link Kernel}. */
  kernel: number;
  /** γ or c, if one is given, or the number of looks. */
  parameter: number;
  scores: boolean;
  /** A negative number means that it is automatic. */
  thickness: number;
}

export const Rule = { auto: 0, opposite: 1, radius: 2, exponent: 3 } as const;
export const Kernel = { spherical: 0, power: 1, automaticExponential: 2, exponential: 3, looks: 4 } as const;

/** The thickness that stands for `"auto"`. */
const AUTOMATIC = -1;

export const VIEW_OPTIONS = ["radius", "exponent", "inversion", "looks", "scores", "thickness", "within"] as const;

/** Reads the options and checks their types. The core checks the ranges, since it knows the distances. */
export function viewSettings(given: Record<string, unknown>, dimension: number): ViewSettings {
  return {
    ...chosenRadius(given),
    ...(chosenLooks(given, dimension) ?? chosenInversion(given["inversion"])),
    scores: wantsScores(given),
    thickness: chosenThickness(given),
    ...withinSettings(given["within"], dimension),
  };
}

/** The settings of a view without options. */
export const NO_OPTIONS: ViewSettings = {
  rule: Rule.auto,
  size: 0,
  kernel: Kernel.spherical,
  parameter: 0,
  scores: false,
  thickness: AUTOMATIC,
  ...ALL_POINTS,
};

/** The rule of `autoRadius`, as settings. */
export function ruleSettings(rule: unknown): ViewSettings {
  if (rule !== undefined && !isRule(rule)) {
    throw new HprError("option", `the rule must be "auto" or "opposite", got ${describe(rule)}`);
  }
  return { ...NO_OPTIONS, rule: Rule[rule ?? "auto"] };
}

/** The inversion in the answer to a view with these settings. `scales` are the values of c that were used. */
export function resolvedInversion({ kernel, parameter }: ViewSettings, scales: readonly number[]): ResolvedInversion {
  switch (kernel) {
    case Kernel.power:
      return { power: parameter };
    case Kernel.automaticExponential:
    case Kernel.exponential:
      return { exponential: scales[0]! };
    case Kernel.looks:
      return { looks: scales.slice(0, parameter) };
    default:
      return "spherical";
  }
}

/** Refuses an option or method that works only in three dimensions. The message is the crate's. */
export function requireSpace(what: string, dimension: number): void {
  if (dimension !== 3) {
    throw new HprError("option", `${what} needs a cloud of dimension 3, not ${dimension}`);
  }
}

export function chosenRadius(given: Record<string, unknown>): Pick<ViewSettings, "rule" | "size"> {
  const { radius } = given;
  const exponent = number(given, "exponent");
  if (radius !== undefined && exponent !== undefined) {
    throw new HprError("option", "radius and exponent exclude each other; give one of the two");
  }
  if (exponent !== undefined) {
    return { rule: Rule.exponent, size: exponent };
  }
  if (typeof radius === "number") {
    return { rule: Rule.radius, size: radius };
  }
  if (radius !== undefined && !isRule(radius)) {
    throw new HprError("option", `radius must be a number, "auto" or "opposite", got ${describe(radius)}`);
  }
  return { rule: Rule[radius ?? "auto"], size: 0 };
}

/** The settings for `looks`, if the option is given. */
function chosenLooks(
  given: Record<string, unknown>,
  dimension: number,
): Pick<ViewSettings, "kernel" | "parameter"> | undefined {
  const looks = integer(given, "looks", 2, 3);
  if (looks === undefined) {
    return undefined;
  }
  const excluded = ["radius", "exponent", "inversion"].find((name) => given[name] !== undefined);
  if (excluded !== undefined) {
    throw new HprError("option", `looks and ${excluded} exclude each other; give one of the two`);
  }
  requireSpace("looks", dimension);
  return { kernel: Kernel.looks, parameter: looks };
}

function wantsScores(given: Record<string, unknown>): boolean {
  const scores = flag(given, "scores");
  if (scores && given["looks"] === undefined) {
    throw new HprError("option", "scores can be asked for only with looks");
  }
  return scores;
}

function chosenThickness({ looks, thickness }: Record<string, unknown>): number {
  if (thickness !== undefined && looks === undefined) {
    throw new HprError("option", "thickness can be given only with looks");
  }
  if (thickness === undefined || thickness === "auto") {
    return AUTOMATIC;
  }
  if (typeof thickness !== "number" || !(thickness >= 0 && thickness < Infinity)) {
    throw new HprError(
      "option",
      `thickness must be a finite number, at least 0, or "auto", got ${describe(thickness)}`,
    );
  }
  return thickness;
}

export function chosenInversion(inversion: unknown): Pick<ViewSettings, "kernel" | "parameter"> {
  if (inversion === undefined || inversion === "spherical") {
    return { kernel: Kernel.spherical, parameter: 0 };
  }
  if (typeof inversion !== "object") {
    throw new HprError(
      "option",
      `inversion must be "spherical", { power } or { exponential }, got ${describe(inversion)}`,
    );
  }
  const { power, exponential } = entriesOf("inversion", inversion, ["power", "exponential"]);
  if ((power === undefined) === (exponential === undefined)) {
    throw new HprError("option", "inversion must have one of power and exponential");
  }
  if (typeof power === "number") {
    return { kernel: Kernel.power, parameter: power };
  }
  if (power !== undefined) {
    throw new HprError("option", `inversion power must be a number, got ${describe(power)}`);
  }
  if (exponential === "auto") {
    return { kernel: Kernel.automaticExponential, parameter: 0 };
  }
  if (typeof exponential !== "number") {
    throw new HprError("option", `inversion exponential must be a number or "auto", got ${describe(exponential)}`);
  }
  return { kernel: Kernel.exponential, parameter: exponential };
}

/** Refuses what a question of several views does not give. */
export function refuseScores({ scores }: { scores?: unknown }, question: string): void {
  if (scores !== undefined && scores !== false) {
    throw new HprError("option", `scores cannot be combined with ${question}`);
  }
}

/** Refuses an option or method that needs at most three dimensions. The message is the crate's. */
export function requireLow(what: string, dimension: number): void {
  if (dimension > 3) {
    requireSpace(what, dimension);
  }
}

function isRule(value: unknown): value is RadiusRule {
  return value === "auto" || value === "opposite";
}
