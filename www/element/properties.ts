import { PLACE } from "../settings/kinds.ts";
import { SETTINGS } from "../settings/table.ts";
import { anyValueOf, ATTRIBUTE_NAMES, type AttributeName, rowOf, valueOf } from "./attributes.ts";

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
