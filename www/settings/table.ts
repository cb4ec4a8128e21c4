import type { Up } from "../cloud/cloud.ts";
import {
  between,
  BOX,
  CLASSES,
  INVERSION,
  type Kind,
  NAME,
  oneNumberOf,
  oneOf,
  orNone,
  orWord,
  PLACE,
  POSITIVE,
  RADIUS,
  wholeBetween,
} from "./kinds.ts";
import {
  type Box,
  type Classes,
  FIELD_OF_VIEW,
  type HiddenMode,
  type Inversion,
  type Looks,
  MAX_POINTS,
  MOST_EXPONENT,
  POINT_SIZE,
  type Radius,
  type SurfaceChoice,
  type ThemeChoice,
  type Viewpoint,
} from "./limits.ts";

/*
 * The one table of settings. The address, the panel and the element's attributes are made from it, and the tables in the
 * documents are compared with it. A new setting is one row here, and its control in index.html.
 */

/** A parameter of the page's address. */
export interface Parameter<T> extends Kind<T> {
  /** Its name in a sentence. If this is missing, the sentence has the parameter's own name. */
  called?: string;
  /** The end of a sentence about a value that cannot be used, after "so". */
  otherwise: string;
}

/** A parameter of any type. */
export type AnyParameter = Omit<Parameter<never>, "parse"> & { parse: (text: string) => unknown };

/** Something that can be set on the page. */
export interface Setting<T> extends Parameter<T> {
  usual: T;
  /** Its name in the address. */
  parameter: string;
  /** The setting belongs to one cloud. The next cloud begins with the usual value. */
  ofCloud?: true;
}

function setting<T>(row: Setting<T>): Setting<T> {
  return row;
}

function parameter<T>(row: Parameter<T>): Parameter<T> {
  return row;
}

/** The file's own colors. */
export const OWN_COLORS = "own";

/** The colors by what stations see. They are there only as long as there are stations, so no address asks for them. */
export const STATION_COLORS = "seen by stations";

/** The modes in the order of the panel. The key goes through them in the same order. */
export const HIDDEN_MODES: readonly HiddenMode[] = ["off", "dimmed", "shown"];

export const SETTINGS = {
  radius: setting<Radius>({
    parameter: "radius",
    ...RADIUS,
    usual: { rule: "auto" },
    otherwise: "the automatic one is used",
  }),
  looks: setting<Looks>({
    parameter: "looks",
    ...oneNumberOf<Looks>(0, 2, 3),
    usual: 3,
    called: "number of looks",
    otherwise: "it is 3",
  }),
  thickness: setting<number | "auto">({
    parameter: "thickness",
    ...orWord(POSITIVE, "auto", "auto"),
    values: "`auto` or a positive length",
    usual: "auto",
    otherwise: "it follows from the noise of the cloud",
    ofCloud: true,
  }),
  surface: setting<SurfaceChoice>({
    parameter: "surface",
    ...oneOf<SurfaceChoice>("auto", "clean", "noisy", "layered"),
    usual: "auto",
    called: "kind of surface",
    otherwise: "it is found from the points",
    ofCloud: true,
  }),
  inversion: setting<Inversion>({
    parameter: "inversion",
    ...INVERSION,
    usual: "spherical",
    otherwise: "it is spherical",
  }),
  box: setting<Box | null>({
    parameter: "box",
    ...orNone(BOX),
    usual: null,
    otherwise: "all points take part",
    ofCloud: true,
  }),
  without: setting<Classes | null>({
    parameter: "without",
    ...orNone(CLASSES),
    usual: null,
    called: "list of classes",
    otherwise: "all points take part",
    ofCloud: true,
  }),
  freeze: setting<Viewpoint | null>({
    parameter: "freeze",
    ...orNone(PLACE),
    usual: null,
    called: "frozen viewpoint",
    otherwise: "the viewpoint goes with the camera",
    ofCloud: true,
  }),
  hidden: setting<HiddenMode>({
    parameter: "hidden",
    ...oneOf(...HIDDEN_MODES),
    usual: "off",
    called: "way to show hidden points",
    otherwise: "they are off",
  }),
  compare: setting<number | null>({
    parameter: "compare",
    ...orNone(between(0, 1)),
    usual: null,
    called: "place of the divider",
    otherwise: "the picture is not divided",
  }),
  color: setting<string>({
    parameter: "color",
    ...NAME,
    values: "`own`, `plain`, `height` or the name of an attribute of the file",
    usual: OWN_COLORS,
    otherwise: "it has its usual colors",
    ofCloud: true,
  }),
  size: setting<number>({
    parameter: "size",
    ...between(POINT_SIZE.least, POINT_SIZE.most),
    usual: 1,
    called: "point size",
    otherwise: "the usual one is used",
    ofCloud: true,
  }),
  fieldOfView: setting<number>({
    parameter: "fov",
    ...between(FIELD_OF_VIEW.least, FIELD_OF_VIEW.most, "a number of degrees"),
    usual: 45,
    called: "field of view",
    otherwise: "the usual one is used",
    ofCloud: true,
  }),
  up: setting<Up>({
    parameter: "up",
    ...oneOf<Up>("y", "z", "-y"),
    usual: "y",
    called: "side that is up",
    otherwise: "the usual one is used",
    ofCloud: true,
  }),
  theme: setting<ThemeChoice>({
    parameter: "theme",
    ...oneOf<ThemeChoice>("system", "dark", "light"),
    usual: "system",
    otherwise: "it is the system’s",
  }),
};

export type SettingName = keyof typeof SETTINGS;

/** The stories that the page tells, and the sample that each of them is about. */
export const STORIES = { measure: "street", label: "room", survey: "street" } as const;

export type StoryName = keyof typeof STORIES;

/** Parameters of the address that are not settings. */
export const PARAMETERS = {
  view: parameter<Viewpoint>({
    ...PLACE,
    otherwise: "the usual view is used",
  }),
  target: parameter<Viewpoint>({
    ...PLACE,
    otherwise: "the camera looks at the middle",
  }),
  // Another way to write the radius.
  exponent: parameter<number>({
    ...between(0, MOST_EXPONENT),
    otherwise: "the automatic one is used",
  }),
  points: parameter<number>({
    ...wholeBetween(1, MAX_POINTS),
    called: "number of points",
    otherwise: "the largest of these is used",
  }),
  turn: parameter<"0" | "1">({
    ...oneOf("0", "1"),
    otherwise: "the picture stands still",
  }),
  story: parameter<StoryName>({
    ...oneOf<StoryName>("measure", "label", "survey"),
    otherwise: "none is told",
  }),
};

/** The end of a sentence about a value that cannot be used, after "is not". */
export function refusalOf({ values, otherwise }: Pick<AnyParameter, "values" | "otherwise">): string {
  return `${values.replaceAll("`", "")}, so ${otherwise}`;
}
