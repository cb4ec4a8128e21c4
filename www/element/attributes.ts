import { type Settings, USUAL_SETTINGS } from "../settings/settings.ts";
import { SAMPLES } from "../samples/samples.ts";
import { type ValueName, type ValueOf, VALUES, type Written } from "../settings/values.ts";
import type { AskedView } from "../view/framing.ts";
import { Problem } from "./problem.ts";

/** By attribute: what the same is called in the page's address, whose values are written the same way. */
const WRITTEN_AS = {
  limit: "points",
  exponent: "exponent",
  radius: "radius",
  inversion: "inversion",
  "hidden-points": "hidden",
  viewpoint: "view",
  target: "target",
  "point-size": "size",
  fov: "fov",
  up: "up",
} as const satisfies Record<string, ValueName>;

export type WrittenAttribute = keyof typeof WRITTEN_AS;

/** Those that say which points there are. */
export const SOURCES: readonly string[] = ["src", "sample", "limit", "skip-non-finite"];
export const ATTRIBUTES: readonly string[] = [
  ...new Set([...SOURCES, ...Object.keys(WRITTEN_AS), "frozen", "color", "label", "announce"]),
];

/** What the attributes say together. */
export interface Reading {
  src: string | null;
  sample: string | null;
  limit: number | undefined;
  skipNonFinite: boolean;
  /** Of the settings those that are asked for. */
  settings: Partial<Settings>;
  frozen: boolean;
  view: AskedView | null;
  /** By attribute. */
  problems: Map<string, Problem>;
}

/** What an attribute says; `undefined` where it is not there, or says nothing that can be used. */
export function valueOf<Name extends WrittenAttribute>(
  element: Element,
  attribute: Name,
): ValueOf<(typeof WRITTEN_AS)[Name]> | undefined {
  const text = element.getAttribute(attribute);
  return text === null ? undefined : writtenAs(attribute).parse(text);
}

export function readAttributes(element: Element): Reading {
  const problems = new Map<string, Problem>();
  const refuse = (attribute: string, sentence: string) =>
    problems.set(attribute, new Problem("attribute", sentence, { attribute }));
  const read = <Name extends WrittenAttribute>(attribute: Name) => {
    const value = valueOf(element, attribute);
    const text = element.getAttribute(attribute);
    if (text !== null && value === undefined)
      refuse(attribute, `The attribute ${attribute}="${text}" is not ${writtenAs(attribute).refusal}.`);
    return value;
  };

  // An empty one is not an address: it would be that of the page around.
  const src = element.getAttribute("src") || null;
  if (element.getAttribute("src") === "") refuse("src", "The attribute src names no file.");
  let sample = element.getAttribute("sample");
  if (sample !== null && !SAMPLES.some(({ name }) => name === sample)) {
    refuse("sample", `The attribute sample="${sample}" is not one of ${SAMPLES.map(({ name }) => name).join(", ")}.`);
    sample = null;
  }
  if (src !== null && element.hasAttribute("sample"))
    refuse("sample", "The attributes src and sample exclude each other, so src is used.");

  const [exponent, radius] = [read("exponent"), read("radius")];
  if (exponent !== undefined && radius !== undefined)
    refuse("radius", "The attributes exponent and radius exclude each other, so exponent is used.");
  const [at, target] = [read("viewpoint"), read("target")];
  if (target && !element.hasAttribute("viewpoint"))
    refuse("target", "The attribute target needs a viewpoint to be looked at from, so the usual view is used.");
  const settings: Partial<Record<keyof Settings, unknown>> = {
    radius: exponent === undefined ? radius : { exponent },
    inversion: read("inversion"),
    hidden: read("hidden-points"),
    color: element.getAttribute("color") ?? undefined,
    size: read("point-size"),
    fieldOfView: read("fov"),
    up: read("up"),
  };
  const limit = read("limit");
  for (const name of src === null && sample !== null ? SOURCES.slice(2) : []) {
    if (element.hasAttribute(name)) refuse(name, `The attribute ${name} is for files; the samples are as they are.`);
  }
  return {
    src,
    sample,
    limit,
    skipNonFinite: element.hasAttribute("skip-non-finite"),
    settings: Object.fromEntries(Object.entries(settings).filter(([, value]) => value !== undefined)),
    frozen: element.hasAttribute("frozen"),
    view: at ? { at, target: target ?? null } : null,
    problems,
  };
}

/** Of the settings that attributes make, those that are others now: where an attribute is gone, the usual ones. */
export function changedSettings(before: Reading, now: Reading, usual: Partial<Settings>): Partial<Settings> {
  const whole = ({ settings }: Reading): Settings => ({ ...USUAL_SETTINGS, ...usual, ...settings });
  const [old, next] = [whole(before), whole(now)];
  const changed = Object.entries(next).filter(
    ([name, value]) => JSON.stringify(value) !== JSON.stringify(old[name as keyof Settings]),
  );
  return Object.fromEntries(changed);
}

function writtenAs<Name extends WrittenAttribute>(attribute: Name): Written<ValueOf<(typeof WRITTEN_AS)[Name]>> {
  return VALUES[WRITTEN_AS[attribute]] as unknown as Written<ValueOf<(typeof WRITTEN_AS)[Name]>>;
}
