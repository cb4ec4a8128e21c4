import type { Up } from "../cloud/cloud.ts";
import { MOST_SPLAT } from "../compare/zbuffer.ts";
import { MAX_POINTS } from "../loaders/limits.ts";
import type {
  Against,
  HiddenMode,
  Inversion,
  Radius,
  Settings,
  ThemeChoice,
  Viewpoint,
  Viewpoints,
} from "./settings.ts";

/** How a value is written as text, and how a sentence ends about a text that is none: "is not …". */
export interface Written<T> {
  /** `undefined` for what cannot be used. */
  parse: (text: string) => T | undefined;
  refusal: string;
}

/** The end of the slider. */
const MOST_EXPONENT = 6;
const MOST_POWER = 16;
/** Neighbors that smooth noise; the library's limit is the cloud, but time is the page's: with so many, a large sample takes minutes. */
const MOST_NEIGHBORS = 100;

/** By the names they have in the page's address. */
export const VALUES = {
  exponent: written(within(0, MOST_EXPONENT), `a number from 0 to ${MOST_EXPONENT}, so the automatic one is used`),
  radius: written(parseRadius, "auto, search, opposite or a positive number, so the automatic one is used"),
  inversion: written(
    parseInversion,
    `spherical, exponential, exponential:c with a positive c or power:γ with γ above 1 and at most ${MOST_POWER}, so it is spherical`,
  ),
  viewpoints: written(oneOf<Viewpoints>("one", "any", "two"), "one, any or two, so it is one"),
  denoise: written(whole(MOST_NEIGHBORS), `an integer from 0 to ${MOST_NEIGHBORS}, so noise is left as it is`),
  vote: written(whole(MOST_NEIGHBORS), `an integer from 0 to ${MOST_NEIGHBORS}, so there is no vote`),
  show: written(oneOf<Settings["show"]>("points", "surface"), "points or surface, so points are shown"),
  edge: written(parseEdge, "a positive number of spacings or all, so it is 5"),
  soft: written(within(0, 1), "a number from 0 to 1, so lights are points"),
  ambient: written(within(0, 1), "a number from 0 to 1, so the usual one is used"),
  smoothing: written(whole(1000), "an integer from 0 to 1000, so it is 1"),
  freeze: written(parsePlace, "three numbers x,y,z, so the viewpoint goes with the camera"),
  hidden: written(oneOf<HiddenMode>("off", "dimmed", "shown"), "off, dimmed or shown, so they are off"),
  compare: written(within(0, 1), "a number from 0 to 1, so the picture is not divided"),
  against: written(oneOf<Against>("all", "zbuffer", "surface"), "all, zbuffer or surface, so all points are"),
  splat: written(parseSplat, `auto or an integer from 1 to ${MOST_SPLAT}, so it is chosen by the view`),
  size: written(within(0.05, 50), "a number from 0.05 to 50, so the usual one is used"),
  fov: written(within(5, 100), "a number of degrees from 5 to 100, so the usual one is used"),
  up: written(oneOf<Up>("y", "z", "-y"), "y, z or -y, so the usual one is used"),
  theme: written(oneOf<ThemeChoice>("system", "dark", "light"), "system, dark or light, so it is the system’s"),
  view: written(parsePlace, "three numbers x,y,z, so the usual view is used"),
  target: written(parsePlace, "three numbers x,y,z, so the camera looks at the middle"),
  points: written(
    (text) => whole(MAX_POINTS)(text) || undefined,
    `an integer from 1 to ${MAX_POINTS}, so the largest of these is used`,
  ),
  embed: written(oneOf("0", "1"), "0 or 1, so the controls are shown"),
};

export type ValueName = keyof typeof VALUES;
export type ValueOf<Name extends ValueName> = (typeof VALUES)[Name] extends Written<infer T> ? T : never;

function written<T>(parse: Written<T>["parse"], refusal: string): Written<T> {
  return { parse, refusal };
}

function parseRadius(text: string): Radius | undefined {
  const rule = oneOf<"auto" | "search" | "opposite">("auto", "search", "opposite")(text);
  if (rule) return { rule };
  const length = parseNumber(text);
  return length > 0 && length < Infinity ? { length } : undefined;
}

/** A kind, and after a colon its parameter. */
function parseInversion(text: string): Inversion | undefined {
  const [kind, parameter, ...more] = text.split(":");
  if (more.length > 0) return undefined;
  const value = parameter === undefined ? "auto" : parseNumber(parameter);
  if (kind === "spherical" && parameter === undefined) return "spherical";
  if (kind === "exponential" && (value === "auto" || (value > 0 && value < Infinity))) return { exponential: value };
  if (kind === "power" && (value === "auto" || (value > 1 && value <= MOST_POWER))) return { power: value };
  return undefined;
}

function parseEdge(text: string): number | undefined {
  if (text === "all") return Infinity;
  const edge = parseNumber(text);
  return edge > 0 && edge < Infinity ? edge : undefined;
}

function parseSplat(text: string): number | "auto" | undefined {
  const width = text === "auto" ? text : whole(MOST_SPLAT)(text);
  return width === 0 ? undefined : width;
}

export function parsePlace(text: string): Viewpoint | undefined {
  const numbers = text.split(",").map(parseNumber);
  return numbers.length === 3 && numbers.every(Number.isFinite) ? (numbers as Viewpoint) : undefined;
}

function within(least: number, most: number): (text: string) => number | undefined {
  return (text) => {
    const value = parseNumber(text);
    return value >= least && value <= most ? value : undefined;
  };
}

function whole(most: number): (text: string) => number | undefined {
  return (text) => {
    const value = within(0, most)(text);
    return Number.isInteger(value) ? value : undefined;
  };
}

function oneOf<T extends string>(...values: T[]): (text: string) => T | undefined {
  return (text) => values.find((value) => value === text);
}

/** Like Number, but an empty text is no number. */
function parseNumber(text: string): number {
  return text.trim() === "" ? NaN : Number(text);
}
