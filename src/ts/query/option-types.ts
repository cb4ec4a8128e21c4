import type { Viewpoint } from "./positions.js";

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

/** Options that may not be given. */
export type Without<Option extends string> = { readonly [Name in Option]?: undefined };

/** What a cloud is: even samples of a surface, a sensor's noise everywhere, or registered scans. */
export type SurfaceKind = "clean" | "noisy" | "layered";

/** A cone of directions. */
export interface Cone {
  /** x, y, z of its axis, of any length but 0. */
  direction: Viewpoint;
  /** Its full opening in degrees, above 0 and at most 360. */
  angle: number;
}

/**
 * Which points take part in a view. A point must meet all of the given conditions. The other points
 * are not visible and hide nothing.
 */
export interface Within {
  /** The points at most this far from the viewpoint, in the cloud's units. At least 0. */
  distance?: number | undefined;
  /** The points in this box, its faces included: `[min, max]`, each with as many numbers as a point. */
  box?: readonly [min: Viewpoint, max: Viewpoint] | undefined;
  /** The points whose byte is not 0. There is one byte for each index of the cloud. */
  mask?: Uint8Array | undefined;
}
