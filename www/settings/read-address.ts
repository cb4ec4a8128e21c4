import { canLook, rowOf, type Settings, USUAL_SETTINGS, type Viewpoint, withLooks } from "./settings.ts";
import { type Parameter, PARAMETERS, refusalOf, type SettingName, SETTINGS, STORIES, type StoryName } from "./table.ts";

/** What the address of the page asks for. The notes name, in plain words, everything that cannot be used. */
export interface Wishes {
  sample: string;
  src: string | null;
  /** Where the camera stands, in the file's own coordinates, and what it looks at. */
  view: Viewpoint | null;
  target: Viewpoint | null;
  /** The most points of a file that are shown. `null`: as many as the page can show. */
  points: number | null;
  /** Whether the picture turns by itself. */
  turns: boolean;
  /** The story that is told. It chooses the sample. */
  story: StoryName | null;
  /** Whether the address asks for nothing, but maybe for whether the picture turns. */
  isFirst: boolean;
  /** The settings that are in the address. */
  settings: Partial<Settings>;
  notes: string[];
}

/** Reads the address. The first sample is the usual one. */
export function readAddress(search: string, samples: readonly string[]): Wishes {
  const query = new URLSearchParams(search);
  const notes: string[] = [];

  let sample = query.get("sample") ?? samples[0]!;
  if (!samples.includes(sample)) {
    notes.push(`There is no sample called “${sample}”, so this is the ${samples[0]}.`);
    sample = samples[0]!;
  }
  const src = query.get("src");
  if (src === "") notes.push(`The address names no file after “src=”, so this is the ${sample}.`);

  /** Returns `undefined` if the address does not have the parameter, or if its value cannot be used. */
  const read = <T>(name: string, row: Parameter<T>, otherwise: { otherwise?: string } = {}): T | undefined => {
    const text = query.get(name);
    const value = text === null ? undefined : row.parse(text);
    if (text !== null && value === undefined) {
      notes.push(`The ${row.called ?? name} in the address is not ${refusalOf({ ...row, ...otherwise })}.`);
    }
    return value;
  };

  // The radius is the other way to say the same.
  const isRadiusGiven = SETTINGS.radius.parse(query.get("radius") ?? "") !== undefined;
  const exponent = read("exponent", PARAMETERS.exponent, isRadiusGiven ? { otherwise: "the radius is used" } : {});
  const found: Partial<Record<SettingName, unknown>> = {};
  for (const name of Object.keys(SETTINGS) as SettingName[]) {
    const row = rowOf(name);
    const value = read(row.parameter, row);
    if (value !== undefined) found[name] = value;
  }
  let settings = found as Partial<Settings>;
  if (settings.radius && exponent !== undefined) {
    notes.push("Radius and exponent in the address exclude each other, so the exponent is used.");
  }
  if (exponent !== undefined) settings.radius = { exponent };
  settings = withLooks(settings);
  if (settings.looks && !canLook({ ...USUAL_SETTINGS, ...settings })) {
    notes.push(
      "Looks in the address exclude exponent, radius and inversion, so there is one hull, as these parameters say.",
    );
  }
  const turn = read("turn", PARAMETERS.turn);
  const story = read("story", PARAMETERS.story) ?? null;
  const isFirst = [...query.keys()].every((name) => name === "turn");

  return {
    sample: story ? STORIES[story] : sample,
    src: src === "" || story ? null : src,
    story,
    view: read("view", PARAMETERS.view) ?? null,
    target: read("target", PARAMETERS.target) ?? null,
    points: read("points", PARAMETERS.points) ?? null,
    turns: turn === undefined ? isFirst : turn === "1",
    isFirst,
    settings,
    notes,
  };
}
