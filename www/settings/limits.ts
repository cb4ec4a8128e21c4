/*
 * The limits of values. Each limit is written only here. The address, the panel, the element, the loaders and the
 * documents take it from here.
 */

import type { Track } from "../controls/controls.ts";

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

/** x, y, z in the file's own coordinates. */
export type Viewpoint = [number, number, number];

/** The lower and the upper corner of a box along the axes. */
export type Box = [low: Viewpoint, high: Viewpoint];

/** Classes of a column that are left out. */
export interface Classes {
  column: string;
  values: number[];
}

/** What happens to the hidden points. */
export type HiddenMode = "off" | "dimmed" | "shown";

/**
 * The radius R of the flipping sphere: chosen automatically, or its length in the file's units, or its exponent
 * log₁₀(R ÷ farthest distance).
 */
export type Radius = { rule: "auto" } | { exponent: number } | { length: number };

/** How many looks make the answer when the camera rests (docs/LOOKS.md). 0: the operator of the paper. */
export type Looks = 0 | 2 | 3;

/** What looks take the cloud to be; `auto`: what the library finds. */
export type SurfaceChoice = "auto" | "clean" | "noisy" | "layered";

/** How points are flipped. The exponential's c is counted in spacings, so that it suits clouds of any size. */
export type Inversion = "spherical" | { exponential: number | "auto" };

/** The colors of the page: those that the system asks for, or always one theme. */
export type ThemeChoice = "system" | "dark" | "light";

/** The files that can be opened, as people write their names. */
export const FORMATS = ["LAS", "LAZ", "E57", "PTX", "PLY", "PCD", "XYZ", "TXT", "CSV", "OBJ", "glTF", "GLB"] as const;

/** In a sentence: "LAS, LAZ … glTF or GLB". */
export function listed(words: readonly string[], last: "and" | "or"): string {
  return `${words.slice(0, -1).join(", ")} ${last} ${words.at(-1)!}`;
}

/** The sliders, by the name of their setting or parameter. The address may allow values beyond the ends of a track. */
export const SLIDERS = {
  size: { least: 0.1, most: 5, step: 0.05, text: (at) => `${Number(at.toFixed(2))} ×` },
  fieldOfView: { ...FIELD_OF_VIEW, step: 1, text: (at) => `${Math.round(at)}°` },
  exponent: { least: 0, most: MOST_EXPONENT, step: 0.05, text: (at) => at.toFixed(2) },
} satisfies Record<string, Track>;
