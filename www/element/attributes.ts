import { type AnyParameter, type Parameter, PARAMETERS, type SettingName, SETTINGS } from "../settings/table.ts";

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
  announce: { property: "flag" },
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
