import type { Up } from "./cloud.ts";
import { MAX_POINTS } from "./loaders/limits.ts";
import type { HiddenMode, Inversion, Radius, Settings, ThemeChoice, Viewpoint, Viewpoints } from "./settings.ts";

/** What the address of the page asks for. Anything that cannot be used is named in `notes`, in plain words. */
export interface Params {
  sample: string;
  src: string | null;
  /** Where the camera stands, in the file's own coordinates, and what it looks at. */
  view: Viewpoint | null;
  target: Viewpoint | null;
  /** At most so many points of a file are to be shown; `null` for as many as the page can. */
  points: number | null;
  /** Nothing but the picture. */
  embed: boolean;
  /** Of the settings those that are in the address. */
  settings: Partial<Settings>;
  notes: string[];
}

/** The end of the slider. */
const MOST_EXPONENT = 6;
const MOST_LIGHTS = 8;
const MOST_POWER = 16;
/** Neighbors that smooth noise; the library's limit is the cloud, but time is the page's: with so many, a large sample takes minutes. */
const MOST_NEIGHBORS = 100;

export function readParams(search: string, samples: readonly string[]): Params {
  const query = new URLSearchParams(search);
  const notes: string[] = [];

  let sample = query.get("sample") ?? samples[0]!;
  if (!samples.includes(sample)) {
    notes.push(`There is no sample called “${sample}”, so this is the ${samples[0]}.`);
    sample = samples[0]!;
  }
  const src = query.get("src");
  if (src === "") notes.push(`The address names no file after “src=”, so this is the ${sample}.`);

  /** One value by its name; `undefined` where there is none or none that fits. */
  const read = <T>(name: string, parse: (text: string) => T | undefined, refusal: string): T | undefined => {
    const text = query.get(name);
    const value = text === null ? undefined : parse(text);
    if (text !== null && value === undefined) notes.push(`The ${WORDS[name] ?? name} in the address is not ${refusal}.`);
    return value;
  };

  const exponent = read("exponent", within(0, MOST_EXPONENT), `a number from 0 to ${MOST_EXPONENT}, so the automatic one is used`);
  let radius = read("radius", parseRadius, "auto, search, opposite or a positive number, so the automatic one is used");
  if (radius && exponent !== undefined) {
    notes.push("Radius and exponent in the address exclude each other, so the exponent is used.");
    radius = undefined;
  }
  const lights = query.getAll("light").map(parsePlace);
  if (lights.length > MOST_LIGHTS || lights.includes(undefined)) {
    notes.push(`A light in the address is not three numbers x,y,z, or is one more than ${MOST_LIGHTS}; it is left out.`);
  }

  const settings: Record<keyof Settings, unknown> = {
    radius: exponent === undefined ? radius : { exponent },
    inversion: read("inversion", parseInversion, `spherical, exponential, exponential:c with a positive c or power:γ with γ above 1 and at most ${MOST_POWER}, so it is spherical`),
    viewpoints: read("viewpoints", oneOf<Viewpoints>("one", "any", "two"), "one, any or two, so it is one"),
    denoise: read("denoise", whole(MOST_NEIGHBORS), `an integer from 0 to ${MOST_NEIGHBORS}, so noise is left as it is`),
    vote: read("vote", whole(MOST_NEIGHBORS), `an integer from 0 to ${MOST_NEIGHBORS}, so there is no vote`),
    show: read("show", oneOf<Settings["show"]>("points", "surface"), "points or surface, so points are shown"),
    edge: read("edge", parseEdge, "a positive number of spacings or all, so it is 5"),
    lights: query.has("light") ? lights.filter((light) => light !== undefined).slice(0, MOST_LIGHTS) : undefined,
    soft: read("soft", within(0, 1), "a number from 0 to 1, so lights are points"),
    ambient: read("ambient", within(0, 1), "a number from 0 to 1, so the usual one is used"),
    smoothing: read("smoothing", whole(1000), "an integer from 0 to 1000, so it is 1"),
    freeze: read("freeze", parsePlace, "three numbers x,y,z, so the viewpoint goes with the camera"),
    hidden: read("hidden", oneOf<HiddenMode>("off", "dimmed", "shown"), "off, dimmed or shown, so they are off"),
    compare: read("compare", within(0, 1), "a number from 0 to 1, so the picture is not divided"),
    // Whether the cloud has it, it will tell.
    color: query.get("color") ?? undefined,
    size: read("size", within(0.05, 50), "a number from 0.05 to 50, so the usual one is used"),
    fieldOfView: read("fov", within(5, 100), "a number of degrees from 5 to 100, so the usual one is used"),
    up: read("up", oneOf<Up>("y", "z", "-y"), "y, z or -y, so the usual one is used"),
    theme: read("theme", oneOf<ThemeChoice>("system", "dark", "light"), "system, dark or light, so it is the system’s"),
  };
  return {
    sample,
    src: src === "" ? null : src,
    view: read("view", parsePlace, "three numbers x,y,z, so the usual view is used") ?? null,
    target: read("target", parsePlace, "three numbers x,y,z, so the camera looks at the middle") ?? null,
    points: read("points", (text) => whole(MAX_POINTS)(text) || undefined, `an integer from 1 to ${MAX_POINTS}, so it is the last`) ?? null,
    embed: read("embed", oneOf("0", "1"), "0 or 1, so the controls are shown") === "1",
    settings: Object.fromEntries(Object.entries(settings).filter(([, value]) => value !== undefined)),
    notes,
  };
}

/** Parameters that a sentence calls something else. */
const WORDS: Record<string, string> = {
  compare: "place of the divider",
  edge: "longest edge",
  freeze: "frozen viewpoint",
  fov: "field of view",
  hidden: "way to show hidden points",
  show: "kind of picture",
  size: "point size",
  soft: "softness of the lights",
  ambient: "ambient light",
  points: "number of points",
  up: "side that is up",
  viewpoints: "number of viewpoints",
};

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

function parsePlace(text: string): Viewpoint | undefined {
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
