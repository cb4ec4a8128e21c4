import { SAMPLES } from "../samples/samples.ts";
import { canLook, type Settings, USUAL_SETTINGS, withLooks } from "../settings/settings.ts";
import { refusalOf } from "../settings/table.ts";
import type { AskedView } from "../view/framing.ts";
import {
  anyValueOf,
  ATTRIBUTE_NAMES,
  type AttributeName,
  rowOf,
  type ValueOf,
  type WrittenAttribute,
} from "./attributes.ts";
import { Problem } from "./problem.ts";

/** The content of all attributes together. */
export interface Reading {
  src: string | null;
  sample: string | null;
  limit: number | undefined;
  skipNonFinite: boolean;
  /** The settings that are asked for. */
  settings: Partial<Settings>;
  frozen: boolean;
  view: AskedView | null;
  /** The problem of each attribute that has one. */
  problems: Map<string, Problem>;
}

export function readAttributes(element: Element): Reading {
  const problems = new Map<string, Problem>();
  const refuse = (attribute: AttributeName, sentence: string) =>
    problems.set(attribute, new Problem("attribute", sentence, { attribute }));
  const readAny = (attribute: AttributeName): unknown => {
    const value = anyValueOf(element, attribute);
    const text = element.getAttribute(attribute);
    const { written } = rowOf(attribute);
    if (written && text !== null && value === undefined) {
      refuse(attribute, `The attribute ${attribute}="${text}" is not ${refusalOf(written)}.`);
    }
    return value;
  };
  const read = <Name extends WrittenAttribute>(attribute: Name) => readAny(attribute) as ValueOf<Name> | undefined;

  // An empty text is not used as an address: it would be the address of the page itself.
  const src = element.getAttribute("src") || null;
  if (element.getAttribute("src") === "") refuse("src", "The attribute src names no file.");
  let sample = element.getAttribute("sample");
  if (sample !== null && !SAMPLES.some(({ name }) => name === sample)) {
    refuse("sample", `The attribute sample="${sample}" is not one of ${SAMPLES.map(({ name }) => name).join(", ")}.`);
    sample = null;
  }
  if (src !== null && element.hasAttribute("sample")) {
    refuse("sample", "The attributes src and sample exclude each other, so src is used.");
  }
  const limit = read("limit");
  if (src === null && sample !== null) {
    for (const name of ["limit", "skip-non-finite"] as const) {
      if (element.hasAttribute(name)) refuse(name, `The attribute ${name} is for files; the samples are as they are.`);
    }
  }

  const settings: Record<string, unknown> = {};
  for (const name of ATTRIBUTE_NAMES) {
    const { setting } = rowOf(name);
    const value = setting && readAny(name);
    if (setting && value !== undefined) settings[setting] = value;
  }
  const exponent = read("exponent");
  if (exponent !== undefined && settings["radius"] !== undefined) {
    refuse("radius", "The attributes exponent and radius exclude each other, so exponent is used.");
  }
  if (exponent !== undefined) settings["radius"] = { exponent };
  if (settings["looks"] && !canLook({ ...USUAL_SETTINGS, ...settings })) {
    refuse("looks", "The attribute looks excludes exponent, radius and inversion, so there is one hull.");
  }
  const [at, target] = [read("viewpoint"), read("target")];
  if (target && !element.hasAttribute("viewpoint")) {
    refuse("target", "The attribute target needs a viewpoint to be looked at from, so the usual view is used.");
  }
  return {
    src,
    sample,
    limit,
    skipNonFinite: element.hasAttribute("skip-non-finite"),
    settings: withLooks(settings),
    frozen: element.hasAttribute("frozen"),
    view: at ? { at, target: target ?? null } : null,
    problems,
  };
}

/** The settings that differ between two readings. A setting without its attribute has its usual value. */
export function changedSettings(before: Reading, now: Reading, usual: Partial<Settings>): Partial<Settings> {
  const whole = ({ settings }: Reading): Settings => ({ ...USUAL_SETTINGS, ...usual, ...settings });
  const [old, next] = [whole(before), whole(now)];
  const changed = Object.entries(next).filter(
    ([name, value]) => JSON.stringify(value) !== JSON.stringify(old[name as keyof Settings]),
  );
  return Object.fromEntries(changed);
}
