import { shownKeys } from "../controls/keys.ts";
import { SAMPLES } from "../samples/samples.ts";
import { FORMATS, listed } from "../settings/formats.ts";
import { type AnyParameter, type Parameter, PARAMETERS, type SettingName, SETTINGS } from "../settings/table.ts";

/** An attribute of the element. Its property has the same name in camel case. */
export interface Attribute {
  /** Its meaning, for the documents. */
  is: string;
  /** What holds without it, for the documents. */
  without?: string;
  /** How its value is written; where this is missing, any text will do, or it is a flag. */
  written?: AnyParameter;
  /** The setting that it makes. */
  setting?: SettingName;
  /**
   * The property: the attribute's `text`, a `flag`, the `value` that the text stands for, the text if it can be used
   * (`word`), or an `own` one, which the element defines.
   */
  property: "text" | "flag" | "value" | "word" | "own";
  /** It names the points. */
  ofSource?: true;
}

/** A row of the table of settings or parameters, as an attribute. */
function like<T>(row: Parameter<T>, rest: Omit<Attribute, "written" | "is" | "without"> & Partial<Attribute>) {
  return { is: row.is, ...(row.without === undefined ? {} : { without: row.without }), ...rest, written: row };
}

/** The one table of attributes. The document's table is made from it. */
export const ATTRIBUTES = {
  src: {
    is: `the address of a ${listed(FORMATS, "or")} file; COPC is LAZ. Setting it stops the loading of another file`,
    property: "text",
    ofSource: true,
  },
  sample: {
    is: `a cloud of the demo page, instead of \`src\`: ${listed(
      SAMPLES.map(({ name }) => name),
      "or",
    )}. Those of the dragon and the bunny need the folder \`samples/\` beside the module`,
    property: "text",
    ofSource: true,
  },
  limit: like(PARAMETERS.points, { property: "value", ofSource: true }),
  "skip-non-finite": {
    is: "leaves points out that have no position; the others are numbered anew",
    without: "such a file is refused",
    property: "flag",
    ofSource: true,
  },
  exponent: like(PARAMETERS.exponent, { property: "value" }),
  radius: like(SETTINGS.radius, { setting: "radius", property: "own" }),
  inversion: like(SETTINGS.inversion, { setting: "inversion", property: "word" }),
  "hidden-points": like(SETTINGS.hidden, {
    is: `${SETTINGS.hidden.is}; follows the key \`${shownKeys("hidden").join()}\``,
    setting: "hidden",
    property: "value",
  }),
  frozen: {
    is: `the viewpoint stays where it is while the camera moves on; follows the key \`${shownKeys("freeze").join()}\``,
    without: "the viewpoint goes with the camera",
    property: "flag",
  },
  viewpoint: like(PARAMETERS.view, {
    is: "where the camera is at first. Set again, it moves the camera there again",
    property: "own",
  }),
  target: like(PARAMETERS.target, { is: "what the camera looks at from the `viewpoint`", property: "own" }),
  "point-size": like(SETTINGS.size, { setting: "size", property: "value" }),
  fov: like(SETTINGS.fieldOfView, { setting: "fieldOfView", property: "value" }),
  up: like(SETTINGS.up, {
    is: `${SETTINGS.up.is}. Changing it goes back to the first view`,
    setting: "up",
    property: "value",
  }),
  color: like(SETTINGS.color, { setting: "color", property: "text" }),
  label: {
    is: "what the cloud is, for people who do not see it",
    without: "“Point cloud”",
    property: "text",
  },
  announce: {
    is: "screen readers hear how many points are visible, once that number has settled",
    without: "they do not",
    property: "flag",
  },
} satisfies Record<string, Attribute>;

export type AttributeName = keyof typeof ATTRIBUTES;

/** Those whose values are written as in the page's address. */
export type WrittenAttribute = {
  [Name in AttributeName]: (typeof ATTRIBUTES)[Name] extends { written: unknown } ? Name : never;
}[AttributeName];

export type ValueOf<Name extends WrittenAttribute> =
  (typeof ATTRIBUTES)[Name]["written"] extends Parameter<infer T> ? T : never;

export const ATTRIBUTE_NAMES = Object.keys(ATTRIBUTES) as AttributeName[];

/** Those that name the points. */
export const SOURCES: readonly string[] = ATTRIBUTE_NAMES.filter((name) => rowOf(name).ofSource);

export function rowOf(name: AttributeName): Attribute {
  return ATTRIBUTES[name];
}

/** What an attribute says; `undefined` if it is not there, or cannot be used. */
export function valueOf<Name extends WrittenAttribute>(element: Element, name: Name): ValueOf<Name> | undefined {
  return anyValueOf(element, name) as ValueOf<Name> | undefined;
}

/** The same for an attribute that is not known beforehand. */
export function anyValueOf(element: Element, name: AttributeName): unknown {
  const text = element.getAttribute(name);
  return text === null ? undefined : rowOf(name).written?.parse(text);
}
