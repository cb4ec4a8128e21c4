import { MAX_POINTS, REACH } from "./limits.ts";
import type { PARAMETERS, SettingName } from "./table.ts";

/*
 * The words of the documents and of index.html about the table of settings. They stand apart from the table, since the
 * scripts that are downloaded do not need them. A row without words is a type error.
 */

export interface Words {
  /** The thing that the row sets. */
  is: string;
  /** The value if the address does not have the parameter. If this is missing, it is the usual value. */
  without?: string;
}

/** `labels`: the labels of the choices in the panel, by the text of each choice. */
export type SettingWords = Words & { labels?: Readonly<Record<string, string>> };

const NEIGHBORS = { 0: "Off", 6: "6", 16: "16", 32: "32" };

export const SETTING_WORDS: Record<SettingName, SettingWords> = {
  radius: {
    is: "the radius of the flipping sphere: a rule, or a length in the file’s units. Excludes `exponent`",
  },
  looks: {
    is: "how many looks make the answer when the camera rests; `0` is one hull, as in the paper. Only with the automatic radius and the spherical method",
    without: "`3`; `0` if `exponent`, `radius` or `inversion` is given",
    labels: { 0: "One hull", 2: "2 looks", 3: "3 looks" },
  },
  inversion: {
    is: "how points are flipped; c counts in spacings",
    labels: { spherical: "Spherical", exponential: "Exponential", power: "Power" },
  },
  viewpoints: {
    is: "who has to see a point: the one viewpoint, or of five viewpoints any or at least two",
    labels: { one: "One place", any: "Any of 5", two: "At least 2" },
  },
  denoise: {
    is: "how many nearest neighbors smooth the noise of a point",
    without: "0: off",
    labels: NEIGHBORS,
  },
  vote: {
    is: "how many nearest neighbors vote on a point",
    without: "0: off",
    labels: NEIGHBORS,
  },
  show: {
    is: "the visible points, or the surface between them",
    labels: { points: "Points", surface: "Surface" },
  },
  edge: {
    is: "the longest edge of the surface’s triangles",
  },
  lights: {
    is: "where a light is; with a light there are shadows",
    without: "no light",
  },
  soft: {
    is: "the radius of a light, as a share of its distance from the middle of the cloud",
    without: "0: a point",
  },
  ambient: {
    is: "how bright a point is that no light reaches",
  },
  smoothing: {
    is: "how many rounds smooth the light",
  },
  freeze: {
    is: `where the viewpoint stays while the camera moves on; within ${powerOfTen(REACH)} radii of the cloud`,
    without: "the viewpoint goes with the camera",
  },
  hidden: {
    is: "how hidden points are drawn",
    labels: { off: "Hide", dimmed: "Ghost", shown: "Highlight" },
  },
  compare: {
    is: "where the picture is divided, as a share of its width; visible points are to the right",
    without: "it is not divided",
  },
  against: {
    is: "what is to the left of the divider: all points, the z-buffer of the same picture, or the truth, where the surface is known",
    labels: { all: "All points", zbuffer: "Z-buffer", surface: "True surface" },
  },
  splat: {
    is: "how wide the z-buffer draws a point, in pixels",
  },
  color: {
    is: "what points are colored by",
  },
  size: {
    is: "the size of a point, in multiples of the points’ rough distance from one another",
  },
  fieldOfView: {
    is: "the vertical field of view",
  },
  up: {
    is: "which way is up",
    without: "by the file",
    labels: { y: "Y", z: "Z", "-y": "−Y" },
  },
  theme: {
    is: "the colors of the page",
    labels: { system: "System", dark: "Dark", light: "Light" },
  },
};

export const PARAMETER_WORDS: Record<keyof typeof PARAMETERS, Words> = {
  view: {
    is: `where the camera is, in the file’s coordinates; within ${powerOfTen(REACH)} radii of the cloud`,
    without: "all of the cloud is seen",
  },
  target: {
    is: "what the camera looks at",
    without: "the middle of the cloud",
  },
  exponent: {
    is: "the radius as log₁₀ of radius ÷ farthest distance",
    without: "automatic",
  },
  points: {
    is: "how many points of a file are shown at most; of a larger file an even share is shown",
    without: `${MAX_POINTS / 1e6} million`,
  },
  stream: {
    is: "an octree (COPC) with more points than this is streamed: nodes that are hidden are not read",
    without: `${MAX_POINTS / 1e6} million; with \`points\`, nothing is streamed`,
  },
  turn: {
    is: "`1` lets the picture turn by itself until it is touched",
    without: "`1` if the address asks for nothing else",
  },
  embed: {
    is: "`1` shows the picture alone, for a frame in another page",
    without: "`0`",
  },
};

function powerOfTen(value: number): string {
  return `10${String(Math.log10(value)).replace(/\d/g, (digit) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(digit)]!)}`;
}
