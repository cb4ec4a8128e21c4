import type { Settings, Viewpoint } from "./settings.ts";
import { parsePlace, type ValueName, type ValueOf, VALUES, type Written } from "./values.ts";

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

const MOST_LIGHTS = 8;

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
  const read = <Name extends ValueName>(name: Name): ValueOf<Name> | undefined => {
    const text = query.get(name);
    const { parse, refusal } = VALUES[name] as Written<ValueOf<Name>>;
    const value = text === null ? undefined : parse(text);
    if (text !== null && value === undefined)
      notes.push(`The ${WORDS[name] ?? name} in the address is not ${refusal}.`);
    return value;
  };

  const exponent = read("exponent");
  let radius = read("radius");
  if (radius && exponent !== undefined) {
    notes.push("Radius and exponent in the address exclude each other, so the exponent is used.");
    radius = undefined;
  }
  const lights = query.getAll("light").map(parsePlace);
  if (lights.length > MOST_LIGHTS || lights.includes(undefined)) {
    notes.push(
      `A light in the address is not three numbers x,y,z, or is one more than ${MOST_LIGHTS}; it is left out.`,
    );
  }

  const settings: Record<keyof Settings, unknown> = {
    radius: exponent === undefined ? radius : { exponent },
    inversion: read("inversion"),
    viewpoints: read("viewpoints"),
    denoise: read("denoise"),
    vote: read("vote"),
    show: read("show"),
    edge: read("edge"),
    lights: query.has("light") ? lights.filter((light) => light !== undefined).slice(0, MOST_LIGHTS) : undefined,
    soft: read("soft"),
    ambient: read("ambient"),
    smoothing: read("smoothing"),
    freeze: read("freeze"),
    hidden: read("hidden"),
    compare: read("compare"),
    against: read("against"),
    splat: read("splat"),
    // Whether the cloud has it, it will tell.
    color: query.get("color") ?? undefined,
    size: read("size"),
    fieldOfView: read("fov"),
    up: read("up"),
    theme: read("theme"),
  };
  return {
    sample,
    src: src === "" ? null : src,
    view: read("view") ?? null,
    target: read("target") ?? null,
    points: read("points") ?? null,
    embed: read("embed") === "1",
    settings: Object.fromEntries(Object.entries(settings).filter(([, value]) => value !== undefined)),
    notes,
  };
}

/** Parameters that a sentence calls something else. */
const WORDS: Record<string, string> = {
  against: "comparison",
  compare: "place of the divider",
  edge: "longest edge",
  freeze: "frozen viewpoint",
  fov: "field of view",
  hidden: "way to show hidden points",
  show: "kind of picture",
  size: "point size",
  splat: "width of the z-buffer’s points",
  soft: "softness of the lights",
  ambient: "ambient light",
  points: "number of points",
  up: "side that is up",
  viewpoints: "number of viewpoints",
};
