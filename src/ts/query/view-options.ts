import { describe, HprError } from "../base/errors.js";
import { flag, givenOptions, integer, number } from "./options.js";
import { MOST_POINTS } from "./positions.js";

/** How the radius R is chosen where it is not given. */
export type RadiusRule = "auto" | "search" | "opposite";

/**
 * How points are flipped (paper, §3): `"spherical"`, 2R − d; `{ power: γ }`, with
 * 1 < γ ≤ 16, d·(d/S)^−γ, where S is `radius` or else the farthest distance and fixes
 * the rounding only; `{ exponential: c }`, exp(c/d), c in the cloud's units and positive,
 * which is 0.07 of the cloud's spacing for `"auto"`.
 */
export type Inversion = "spherical" | { power: number } | { exponential: number | "auto" };

/**
 * An inversion with numbers only, as an answer tells it; or the c of each look, from tight to
 * loose, which is no option: `looks` asks for it.
 */
export type ResolvedInversion =
  "spherical" | { readonly power: number } | { readonly exponential: number } | { readonly looks: readonly number[] };

/**
 * How one view is computed. At most one of `radius` and `exponent` may be given. With an
 * inversion by `power`, `radius` may be a number, with `exponential` neither is allowed.
 * `looks` excludes all three.
 */
export interface VisibilityOptions {
  /**
   * R, the radius of the sphere that points are flipped about (paper, §3.1, eq. 1), in
   * the cloud's units: finite, and at least the distance of the farthest point. Or how it
   * is chosen: `"auto"`, the default, from the cloud's spacing and the viewpoint;
   * `"search"` by antipodal search, which takes six hulls; `"opposite"` by the paper's own
   * rule (§4), some 40 hulls, mostly far too large in perspective.
   */
  radius?: number | RadiusRule | undefined;
  /** R = farthest distance · 10^exponent, the paper's own parameter; at least 0. */
  exponent?: number | undefined;
  /** How points are flipped; default `"spherical"`. */
  inversion?: Inversion | ResolvedInversion | undefined;
  /**
   * For noisy clouds: before everything else, each point is projected on the
   * least-squares plane of itself and so many nearest others, at least 1 and less than
   * the number of points. Indices and the caller's positions stay.
   */
  denoise?: number | undefined;
  /**
   * For noisy clouds: a point is visible when more than 0.4 of it and so many nearest
   * others are; at least 1 and less than the number of points.
   */
  vote?: number | undefined;
  /**
   * Two or three looks instead of one flip: exact hulls of exp(c/d), c from large to small
   * in the cloud's spacing, each of which decides only what it is sure of. Truer where the
   * sampling is uneven and around silhouettes, for about three times the time, but no longer
   * the operator of the paper: of several points on one ray more than the nearest may be
   * visible, and parts cannot be merged. Needs a cloud of dimension 3.
   */
  looks?: 2 | 3 | undefined;
  /** With `looks`: how sure the answer is, too, as `scores`. For one viewpoint only. */
  scores?: boolean | undefined;
  /**
   * An early answer, in about half of the time: it contains all that is visible, and some
   * of what is hidden. What it leaves out is hidden for certain. Radius and inversion are
   * the exact answer's. The same view asked without `draft` next goes on from it. Not with
   * `radius: "search"` or `"opposite"`, and neither for `reconstruct` nor `illuminate`.
   * Default false.
   */
  draft?: boolean | undefined;
  /**
   * Only an even sample of about so many points takes part: the answer is that of a cloud of
   * the sampled points alone, its own spacing and farthest distance included. The sample
   * depends on the set of points only; a smaller one is part of a larger one. At least 1.
   */
  sample?: number | undefined;
}

/** {@link VisibilityOptions}, checked for type, as the core reads them (src/wasm/options.rs). */
export interface ViewSettings {
  /** A number of {@link Rule}. */
  rule: number;
  /** R or the exponent, where one is given. */
  size: number;
  /** A number of {@link Kernel}. */
  kernel: number;
  /** γ or c, where one is given, or how many looks. */
  parameter: number;
  /** Neighbors; 0 for none. */
  denoise: number;
  vote: number;
  scores: boolean;
  draft: boolean;
  /** How many points; 0 for all. */
  sample: number;
}

export const Rule = { auto: 0, search: 1, opposite: 2, radius: 3, exponent: 4 } as const;
export const Kernel = { spherical: 0, power: 1, automaticExponential: 2, exponential: 3, looks: 4 } as const;

export const VIEW_OPTIONS = [
  "radius",
  "exponent",
  "inversion",
  "denoise",
  "vote",
  "looks",
  "scores",
  "draft",
  "sample",
] as const;

/** Types only: ranges are the core's to check, which knows the distances. */
export function viewSettings(given: Record<string, unknown>, dimension: number): ViewSettings {
  return {
    ...chosenRadius(given),
    ...(chosenLooks(given, dimension) ?? chosenInversion(given["inversion"])),
    denoise: neighbors(given, "denoise", dimension),
    vote: neighbors(given, "vote", dimension),
    scores: wantsScores(given),
    draft: wantsDraft(given, dimension),
    sample: sampled(given, dimension),
  };
}

/** The rule of `autoRadius`, as settings. */
export function ruleSettings(rule: unknown): ViewSettings {
  if (rule !== undefined && !isRule(rule)) {
    throw new HprError("option", `the rule must be "auto", "search" or "opposite", got ${describe(rule)}`);
  }
  return {
    rule: Rule[rule ?? "auto"],
    size: 0,
    kernel: Kernel.spherical,
    parameter: 0,
    denoise: 0,
    vote: 0,
    scores: false,
    draft: false,
    sample: 0,
  };
}

/** What an answer to such a view says of its inversion; `scales` are the c that were used. */
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

/** Refuses what makes sense in three dimensions alone. In the crate's words. */
export function requireSpace(what: string, dimension: number): void {
  if (dimension !== 3) {
    throw new HprError("option", `${what} needs a cloud of dimension 3, not ${dimension}`);
  }
}

function chosenRadius(given: Record<string, unknown>): Pick<ViewSettings, "rule" | "size"> {
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
    throw new HprError("option", `radius must be a number, "auto", "search" or "opposite", got ${describe(radius)}`);
  }
  return { rule: Rule[radius ?? "auto"], size: 0 };
}

/** How many looks, where they are asked for. */
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
  if (flag(given, "draft")) {
    throw new HprError("option", "looks cannot be combined with draft");
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

function chosenInversion(inversion: unknown): Pick<ViewSettings, "kernel" | "parameter"> {
  if (inversion === undefined || inversion === "spherical") {
    return { kernel: Kernel.spherical, parameter: 0 };
  }
  if (typeof inversion !== "object") {
    throw new HprError(
      "option",
      `inversion must be "spherical", { power } or { exponential }, got ${describe(inversion)}`,
    );
  }
  const { power, exponential } = givenInversion(inversion);
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

/** Refusals say which option they are about. */
function givenInversion(inversion: unknown): Record<string, unknown> {
  try {
    return givenOptions(inversion, ["power", "exponential"]);
  } catch (cause) {
    throw cause instanceof HprError ? new HprError(cause.code, `inversion: ${cause.message}`, { cause }) : cause;
  }
}

/** The core, which knows how many points are present, allows fewer; it could not say a greater number. */
function neighbors(given: Record<string, unknown>, name: "denoise" | "vote", dimension: number): number {
  if (given[name] === undefined) {
    return 0;
  }
  requireSpace(name, dimension);
  return integer(given, name, 1, MOST_POINTS - 1) ?? 0;
}

function wantsDraft(given: Record<string, unknown>, dimension: number): boolean {
  const draft = flag(given, "draft");
  if (draft) {
    requireLow("draft", dimension);
  }
  return draft;
}

/** 0 where all points take part. */
function sampled(given: Record<string, unknown>, dimension: number): number {
  if (given["sample"] === undefined) {
    return 0;
  }
  requireLow("sample", dimension);
  return integer(given, "sample", 1, MOST_POINTS) ?? 0;
}

/** Refuses what higher dimensions have not. In the crate's words. */
function requireLow(what: string, dimension: number): void {
  if (dimension > 3) {
    requireSpace(what, dimension);
  }
}

function isRule(value: unknown): value is RadiusRule {
  return value === "auto" || value === "search" || value === "opposite";
}
