import type { Up } from "../cloud/cloud.ts";
import { between, INVERSION, type Kind, NAME, oneOf, orWord, PLACE, POSITIVE, RADIUS, wholeBetween } from "./kinds.ts";
import {
  FIELD_OF_VIEW,
  MAX_POINTS,
  MOST_EXPONENT,
  MOST_LIGHTS,
  MOST_NEIGHBORS,
  MOST_ROUNDS,
  MOST_SPLAT,
  POINT_SIZE,
  REACH,
} from "./limits.ts";
import type { Against, HiddenMode, Inversion, Radius, ThemeChoice, Viewpoint, Viewpoints } from "./types.ts";

/*
 * The one table of what can be set. The address, the panel, the element's attributes and the tables in the documents are
 * made from it. A new setting is one row here, and its control in index.html.
 */

/** A parameter of the page's address. */
export interface Parameter<T> extends Kind<T> {
  /** What it sets. */
  is: string;
  /** What a sentence calls it; its own name where there is no other word. */
  called?: string;
  /** How a sentence ends about a value that cannot be used: "so …". */
  otherwise: string;
  /** What holds where the address does not say it; the usual value where these words are missing. */
  without?: string;
  /** A slider of the panel. */
  slider?: Slider<T>;
}

/** A parameter of whatever type. */
export type AnyParameter = Omit<Parameter<never>, "parse" | "slider"> & { parse: (text: string) => unknown };

/** Something that can be set on the page. */
export interface Setting<T> extends Parameter<T> {
  usual: T;
  /** What the address calls it. */
  parameter: string;
  /** It belongs to one cloud: the next one does not take it over. */
  ofCloud?: true;
  /** The choices that the panel offers, with their labels, by their texts. */
  labels?: Readonly<Record<string, string>>;
}

export interface Slider<T> {
  least: number;
  most: number;
  step: number;
  /** What stands beside the slider for a place on its track. */
  text: (at: number) => string;
  /** Where on the track a value is, and the other way round, where these are not the same number. */
  at?: (value: T) => number;
  from?: (at: number) => T;
}

function setting<T>(row: Setting<T>): Setting<T> {
  return row;
}

function parameter<T>(row: Parameter<T>): Parameter<T> {
  return row;
}

/** The file's own colors. */
export const OWN_COLORS = "own";

/** The library's own default, in spacings. */
export const USUAL_EDGE = 5;
/** The end of the edge's slider stands for all edges. */
const ALL_EDGES = 21;

const NEIGHBORS = { 0: "Off", 6: "6", 16: "16", 32: "32" };

export const SETTINGS = {
  radius: setting<Radius>({
    parameter: "radius",
    ...RADIUS,
    usual: { rule: "auto" },
    is: "the radius of the flipping sphere: a rule, or a length in the file’s units. Excludes `exponent`",
    otherwise: "the automatic one is used",
  }),
  inversion: setting<Inversion>({
    parameter: "inversion",
    ...INVERSION,
    usual: "spherical",
    is: "how points are flipped; c counts in spacings",
    otherwise: "it is spherical",
    labels: { spherical: "Spherical", exponential: "Exponential", power: "Power" },
  }),
  viewpoints: setting<Viewpoints>({
    parameter: "viewpoints",
    ...oneOf<Viewpoints>("one", "any", "two"),
    usual: "one",
    called: "number of viewpoints",
    is: "who has to see a point: the one viewpoint, or of five viewpoints any or at least two",
    otherwise: "it is one",
    labels: { one: "One place", any: "Any of 5", two: "At least 2" },
  }),
  denoise: setting<number>({
    parameter: "denoise",
    ...wholeBetween(0, MOST_NEIGHBORS),
    usual: 0,
    is: "how many nearest neighbors smooth the noise of a point",
    otherwise: "noise is left as it is",
    without: "0: off",
    labels: NEIGHBORS,
  }),
  vote: setting<number>({
    parameter: "vote",
    ...wholeBetween(0, MOST_NEIGHBORS),
    usual: 0,
    is: "how many nearest neighbors vote on a point",
    otherwise: "there is no vote",
    without: "0: off",
    labels: NEIGHBORS,
  }),
  show: setting<"points" | "surface">({
    parameter: "show",
    ...oneOf<"points" | "surface">("points", "surface"),
    usual: "points",
    called: "kind of picture",
    is: "the visible points, or the surface between them",
    otherwise: "points are shown",
    labels: { points: "Points", surface: "Surface" },
  }),
  edge: setting<number>({
    parameter: "edge",
    ...orWord(POSITIVE, "all", Infinity),
    values: "a positive number of spacings or `all`",
    usual: USUAL_EDGE,
    called: "longest edge",
    is: "the longest edge of the surface’s triangles",
    otherwise: `it is ${USUAL_EDGE}`,
    slider: {
      least: 1,
      most: ALL_EDGES,
      step: 0.5,
      text: (at) => (at >= ALL_EDGES ? "all" : `${at} spacings`),
      at: (edge) => (edge === Infinity ? ALL_EDGES : edge),
      from: (at) => (at >= ALL_EDGES ? Infinity : at),
    },
  }),
  lights: setting<readonly Viewpoint[]>({
    parameter: "light",
    parse: (text) => {
      const place = PLACE.parse(text);
      return place && [place];
    },
    write: String,
    values: `${PLACE.values}, once for each of at most ${MOST_LIGHTS} lights`,
    usual: [],
    is: "where a light is; with a light there are shadows",
    otherwise: "it is left out",
    without: "no light",
    ofCloud: true,
  }),
  soft: setting<number>({
    parameter: "soft",
    ...between(0, 1),
    usual: 0,
    called: "softness of the lights",
    is: "the radius of a light, as a share of its distance from the middle of the cloud",
    otherwise: "lights are points",
    without: "0: a point",
    slider: { least: 0, most: 0.5, step: 0.01, text: (at) => (at === 0 ? "point lights" : at.toFixed(2)) },
  }),
  ambient: setting<number>({
    parameter: "ambient",
    ...between(0, 1),
    // Where no light comes one still sees the shapes.
    usual: 0.3,
    called: "ambient light",
    is: "how bright a point is that no light reaches",
    otherwise: "the usual one is used",
    slider: { least: 0, most: 1, step: 0.01, text: (at) => at.toFixed(2) },
  }),
  smoothing: setting<number>({
    parameter: "smoothing",
    ...wholeBetween(0, MOST_ROUNDS),
    usual: 1,
    is: "how many rounds smooth the light",
    otherwise: "it is 1",
    slider: { least: 0, most: 10, step: 1, text: (at) => `${at} ${at === 1 ? "round" : "rounds"}` },
  }),
  freeze: setting<Viewpoint | null>({
    parameter: "freeze",
    parse: PLACE.parse,
    write: String,
    values: PLACE.values,
    usual: null,
    called: "frozen viewpoint",
    is: `where the viewpoint stays while the camera moves on; within ${powerOfTen(REACH)} radii of the cloud`,
    otherwise: "the viewpoint goes with the camera",
    without: "the viewpoint goes with the camera",
    ofCloud: true,
  }),
  hidden: setting<HiddenMode>({
    parameter: "hidden",
    ...oneOf<HiddenMode>("off", "dimmed", "shown"),
    usual: "off",
    called: "way to show hidden points",
    is: "how hidden points are drawn",
    otherwise: "they are off",
    labels: { off: "Off", dimmed: "Dimmed", shown: "Shown" },
  }),
  compare: setting<number | null>({
    parameter: "compare",
    parse: between(0, 1).parse,
    write: String,
    values: between(0, 1).values,
    usual: null,
    called: "place of the divider",
    is: "where the picture is divided, as a share of its width; visible points are to the right",
    otherwise: "the picture is not divided",
    without: "it is not divided",
  }),
  against: setting<Against>({
    parameter: "against",
    ...oneOf<Against>("all", "zbuffer", "surface"),
    usual: "all",
    called: "comparison",
    is: "what is to the left of the divider: all points, the z-buffer of the same picture, or the truth, where the surface is known",
    otherwise: "the comparison is with all points",
    labels: { all: "All points", zbuffer: "Z-buffer", surface: "True surface" },
  }),
  splat: setting<number | "auto">({
    parameter: "splat",
    ...orWord(wholeBetween(1, MOST_SPLAT), "auto", "auto"),
    values: `\`auto\` or an integer from 1 to ${MOST_SPLAT}`,
    usual: "auto",
    called: "width of the z-buffer’s points",
    is: "how wide the z-buffer draws a point, in pixels",
    otherwise: "it is chosen by the view",
    slider: { least: 1, most: MOST_SPLAT, step: 1, text: (at) => `${at} px` },
  }),
  color: setting<string>({
    parameter: "color",
    ...NAME,
    values: "`own`, `plain`, `height` or the name of an attribute of the file",
    usual: OWN_COLORS,
    is: "what points are colored by",
    otherwise: "it has its usual colors",
    ofCloud: true,
  }),
  size: setting<number>({
    parameter: "size",
    ...between(POINT_SIZE.least, POINT_SIZE.most),
    usual: 1,
    called: "point size",
    is: "the size of a point, in multiples of the points’ rough distance from one another",
    otherwise: "the usual one is used",
    without: "by their number",
    ofCloud: true,
    slider: { least: 0.2, most: 5, step: 0.1, text: (at) => `${Number(at.toFixed(1))} ×` },
  }),
  fieldOfView: setting<number>({
    parameter: "fov",
    ...between(FIELD_OF_VIEW.least, FIELD_OF_VIEW.most, "a number of degrees"),
    usual: 45,
    called: "field of view",
    is: "the vertical field of view",
    otherwise: "the usual one is used",
    ofCloud: true,
    slider: { ...FIELD_OF_VIEW, step: 1, text: (at) => `${Math.round(at)}°` },
  }),
  up: setting<Up>({
    parameter: "up",
    ...oneOf<Up>("y", "z", "-y"),
    usual: "y",
    called: "side that is up",
    is: "which way is up",
    otherwise: "the usual one is used",
    without: "by the file",
    ofCloud: true,
    labels: { y: "Y", z: "Z", "-y": "−Y" },
  }),
  theme: setting<ThemeChoice>({
    parameter: "theme",
    ...oneOf<ThemeChoice>("system", "dark", "light"),
    usual: "system",
    is: "the colors of the page",
    otherwise: "it is the system’s",
    labels: { system: "System", dark: "Dark", light: "Light" },
  }),
};

export type SettingName = keyof typeof SETTINGS;

/** Parameters of the address that are no settings. */
export const PARAMETERS = {
  view: parameter<Viewpoint>({
    ...PLACE,
    is: `where the camera is, in the file’s coordinates; within ${powerOfTen(REACH)} radii of the cloud`,
    otherwise: "the usual view is used",
    without: "all of the cloud is seen",
  }),
  target: parameter<Viewpoint>({
    ...PLACE,
    is: "what the camera looks at",
    otherwise: "the camera looks at the middle",
    without: "the middle of the cloud",
  }),
  // Another way to write the radius.
  exponent: parameter<number>({
    ...between(0, MOST_EXPONENT),
    is: "the radius as log₁₀ of radius ÷ farthest distance",
    otherwise: "the automatic one is used",
    without: "automatic",
    slider: { least: 0, most: MOST_EXPONENT, step: 0.05, text: (at) => at.toFixed(2) },
  }),
  points: parameter<number>({
    ...wholeBetween(1, MAX_POINTS),
    called: "number of points",
    is: "how many points of a file are shown at most; of a larger file an even share is shown",
    otherwise: "the largest of these is used",
    without: `${MAX_POINTS / 1e6} million`,
  }),
  embed: parameter<"0" | "1">({
    ...oneOf("0", "1"),
    is: "`1` shows the picture alone, for a frame in another page",
    otherwise: "the controls are shown",
    without: "`0`",
  }),
};

export type ParameterName = keyof typeof PARAMETERS;

/** How a sentence ends about a value that cannot be used: "is not …". */
export function refusalOf({ values, otherwise }: Pick<AnyParameter, "values" | "otherwise">): string {
  return `${values.replaceAll("`", "")}, so ${otherwise}`;
}

function powerOfTen(value: number): string {
  return `10${String(Math.log10(value)).replace(/\d/g, (digit) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(digit)]!)}`;
}
