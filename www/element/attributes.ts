import {
  type AnyParameter,
  type Parameter,
  PARAMETERS,
  refusalOf,
  type SettingName,
  SETTINGS,
} from "../settings/table.ts";
import { SAMPLES } from "../samples/samples.ts";
import { canLook, type Settings, USUAL_SETTINGS, withLooks } from "../settings/settings.ts";
import type { AskedView } from "../view/framing.ts";
import { HprError } from "hidden-point-removal";
import { LoadProblem } from "../loaders/protocol.ts";
import type { HiddenPointCloudError } from "./api.ts";
import { PLACE } from "../settings/kinds.ts";

/** The error of an `error` event. */
export class Problem extends Error implements HiddenPointCloudError {
  override readonly name = "HiddenPointCloudError";
  readonly code: string;
  declare readonly attribute?: string;

  constructor(code: string, message: string, options: { attribute?: string; cause?: unknown } = {}) {
    super(message, "cause" in options ? { cause: options.cause } : {});
    this.code = code;
    if (options.attribute !== undefined) this.attribute = options.attribute;
  }
}

/** Makes a problem of the element from anything that was thrown. */
export function problemOf(thrown: unknown, name: string): Problem {
  if (thrown instanceof Problem) return thrown;
  if (thrown instanceof LoadProblem) return new Problem("source", thrown.message, { cause: thrown });
  const [code, message] = thrown instanceof HprError ? [thrown.code, thrown.message] : ["internal", String(thrown)];
  return new Problem(code, `${name} could not be shown: ${message.replace(/\.$/, "")}.`, { cause: thrown });
}

/** An attribute of the element. Its property has the same name in camel case. */
export interface Attribute {
  /** How its value is written. Without this field, the attribute takes any text, or it is a flag. */
  written?: AnyParameter;
  /** The setting that it sets. */
  setting?: SettingName;
  /**
   * The value of the property. `text`: the attribute's text. `flag`: whether the attribute is there. `value`: the value
   * that the text stands for. `word`: the text, if it can be used. `own`: the element itself defines the property.
   */
  property: "text" | "flag" | "value" | "word" | "own";
  /** The attribute says which points are shown. */
  ofSource?: true;
}

/** The one table of attributes. The table in docs/EMBED.md is compared with it. */
export const ATTRIBUTES = {
  src: { property: "text", ofSource: true },
  sample: { property: "text", ofSource: true },
  limit: { written: PARAMETERS.points, property: "value", ofSource: true },
  "skip-non-finite": { property: "flag", ofSource: true },
  exponent: { written: PARAMETERS.exponent, property: "value" },
  radius: { written: SETTINGS.radius, setting: "radius", property: "own" },
  looks: { written: SETTINGS.looks, setting: "looks", property: "value" },
  inversion: { written: SETTINGS.inversion, setting: "inversion", property: "word" },
  "hidden-points": { written: SETTINGS.hidden, setting: "hidden", property: "value" },
  frozen: { property: "flag" },
  viewpoint: { written: PARAMETERS.view, property: "own" },
  target: { written: PARAMETERS.target, property: "own" },
  "point-size": { written: SETTINGS.size, setting: "size", property: "value" },
  fov: { written: SETTINGS.fieldOfView, setting: "fieldOfView", property: "value" },
  up: { written: SETTINGS.up, setting: "up", property: "value" },
  color: { written: SETTINGS.color, setting: "color", property: "text" },
  label: { property: "text" },
} satisfies Record<string, Attribute>;

export type AttributeName = keyof typeof ATTRIBUTES;

/** The attributes whose values are written as in the page's address. */
export type WrittenAttribute = {
  [Name in AttributeName]: (typeof ATTRIBUTES)[Name] extends { written: unknown } ? Name : never;
}[AttributeName];

export type ValueOf<Name extends WrittenAttribute> =
  (typeof ATTRIBUTES)[Name]["written"] extends Parameter<infer T> ? T : never;

export const ATTRIBUTE_NAMES = Object.keys(ATTRIBUTES) as AttributeName[];

/** The attributes that say which points are shown. */
export const SOURCES: readonly string[] = ATTRIBUTE_NAMES.filter((name) => rowOf(name).ofSource);

export function rowOf(name: AttributeName): Attribute {
  return ATTRIBUTES[name];
}

/** The value of an attribute. `undefined` if the attribute is missing or cannot be used. */
export function valueOf<Name extends WrittenAttribute>(element: Element, name: Name): ValueOf<Name> | undefined {
  return anyValueOf(element, name) as ValueOf<Name> | undefined;
}

/** The value of an attribute, like `valueOf`, for a name that is not known beforehand. */
export function anyValueOf(element: Element, name: AttributeName): unknown {
  const text = element.getAttribute(name);
  return text === null ? undefined : rowOf(name).written?.parse(text);
}

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

/** Gives a class of elements the properties of the attributes, except for the places, which need the camera. */
export function reflect(prototype: Element): void {
  for (const attribute of ATTRIBUTE_NAMES) {
    const get = getterOf(attribute);
    if (!get) continue;
    const isFlag = rowOf(attribute).property === "flag";
    Object.defineProperty(prototype, propertyOf(attribute), {
      configurable: true,
      enumerable: true,
      get(this: Element) {
        return get(this);
      },
      set(this: Element, given: unknown) {
        write(this, attribute, isFlag ? (given ? "" : null) : textOf(given));
      },
    });
  }
}

/** The values of `value` properties whose attribute cannot be used. A property that is not listed is `null` then. */
const OTHERWISE: Partial<Record<AttributeName, unknown>> = { "hidden-points": SETTINGS.hidden.usual };

/** The getter of a property. `null` if the class itself defines the property. */
function getterOf(attribute: AttributeName): ((element: Element) => unknown) | null {
  switch (rowOf(attribute).property) {
    case "text":
      return (element) => element.getAttribute(attribute);
    case "flag":
      return (element) => element.hasAttribute(attribute);
    case "value":
      return (element) => anyValueOf(element, attribute) ?? OTHERWISE[attribute] ?? null;
    case "word":
      return (element) => (anyValueOf(element, attribute) === undefined ? null : element.getAttribute(attribute));
    case "own":
      return attribute === "radius" ? radius : null;
  }
}

/** The radius as a property: the name of a rule, or a number. */
function radius(element: Element): unknown {
  const chosen = valueOf(element, "radius");
  if (!chosen || "exponent" in chosen) return null;
  return "rule" in chosen ? chosen.rule : chosen.length;
}

/** Any value as text: the attribute's own check refuses a text that cannot be used. */
function textOf(given: unknown): string | null {
  // oxlint-disable-next-line typescript/no-base-to-string
  return given === null || given === undefined ? null : String(given);
}

/** Writes an attribute. `null` takes it away. */
export function write(element: Element, attribute: AttributeName, given: string | null): void {
  if (given === null) element.removeAttribute(attribute);
  else element.setAttribute(attribute, given);
}

/**
 * Takes over the properties that were set on an element before the module was loaded. They would hide the properties of
 * the class.
 */
export function adoptEarly(element: Element): void {
  for (const name of ATTRIBUTE_NAMES.map(propertyOf)) {
    const descriptor = Object.getOwnPropertyDescriptor(element, name);
    if (!descriptor) continue;
    // oxlint-disable-next-line typescript/no-dynamic-delete
    delete (element as unknown as Record<string, unknown>)[name];
    (element as unknown as Record<string, unknown>)[name] = descriptor.value;
  }
}

/** The name of the property: the attribute's name in camel case. */
function propertyOf(attribute: AttributeName): string {
  return attribute.replace(/-(\w)/g, (_, letter: string) => letter.toUpperCase());
}

/** A place that a page has given, as three finite numbers. */
export function placeOf(given: ArrayLike<number>): [number, number, number] {
  const place = PLACE.parse(Array.from(given).join(","));
  if (!place) throw new TypeError("expected three finite numbers");
  return place;
}
