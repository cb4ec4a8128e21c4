/*
 * The limits of values. Each limit is written only here. The address, the panel, the element, the loaders and the
 * documents take it from here.
 */

/** From a larger file the page shows an even share of the points. More would take many seconds and gigabytes. */
export const MAX_POINTS = 10_000_000;

/** The page's exponents, log₁₀ of radius ÷ farthest distance, go from 0 to this. */
export const MOST_EXPONENT = 6;

/** Where the line that divides the picture first stands, as a share of its width. */
export const MIDDLE = 0.5;

/** The limits of the size of visible points. With 1, those of a surface touch. */
export const POINT_SIZE = { least: 0.05, most: 50 };

/** The limits of the vertical field of view, in degrees. */
export const FIELD_OF_VIEW = { least: 5, most: 100 };

/** The farthest place from which a cloud can be looked at, in radii of the cloud. Further out, f32 is too coarse. */
export const REACH = 1e6;
