import { parsePlace } from "../settings/values.ts";
import { valueOf, type WrittenAttribute } from "./attributes.ts";

/** A property that is an attribute: what it is for what the attribute says, and what is written there; `null` for nothing. */
interface Reflected {
  attribute: string;
  get: (element: Element) => unknown;
  text: (value: unknown) => string | null;
}

/** Whatever it is: that it is no text or number, the attribute's own check tells. */
// eslint-disable-next-line @typescript-eslint/no-base-to-string
const plainly = (given: unknown) => (given === null || given === undefined ? null : String(given));

function text(attribute: string): Reflected {
  return { attribute, get: (element) => element.getAttribute(attribute), text: plainly };
}

function flag(attribute: string): Reflected {
  return { attribute, get: (element) => element.hasAttribute(attribute), text: (value) => (value ? "" : null) };
}

/** Where the attribute says nothing that can be used, `otherwise`. */
function value(attribute: WrittenAttribute, otherwise: unknown = null): Reflected {
  return { attribute, get: (element) => valueOf(element, attribute) ?? otherwise, text: plainly };
}

/** As written, where that can be used. */
function word(attribute: WrittenAttribute): Reflected {
  return {
    attribute,
    get: (element) => (valueOf(element, attribute) === undefined ? null : element.getAttribute(attribute)),
    text: plainly,
  };
}

/** A rule's name, or a number. */
function radius(element: Element): unknown {
  const chosen = valueOf(element, "radius");
  if (!chosen || "exponent" in chosen) return null;
  return "rule" in chosen ? chosen.rule : chosen.length;
}

/** Those of three numbers have a getter of their own, which knows the camera. */
export const REFLECTED = {
  src: text("src"),
  sample: text("sample"),
  limit: value("limit"),
  skipNonFinite: flag("skip-non-finite"),
  exponent: value("exponent"),
  radius: { attribute: "radius", get: radius, text: plainly },
  inversion: word("inversion"),
  hiddenPoints: value("hidden-points", "off"),
  frozen: flag("frozen"),
  pointSize: value("point-size"),
  fov: value("fov"),
  up: value("up"),
  color: text("color"),
  label: text("label"),
  announce: flag("announce"),
} satisfies Record<string, Reflected>;

/** Gives a class of elements the properties. */
export function reflect(prototype: Element): void {
  for (const [name, { attribute, get, text: written }] of Object.entries(REFLECTED)) {
    Object.defineProperty(prototype, name, {
      configurable: true,
      enumerable: true,
      get(this: Element) {
        return get(this);
      },
      set(this: Element, given: unknown) {
        write(this, attribute, written(given));
      },
    });
  }
}

/** `null` takes the attribute away. */
export function write(element: Element, attribute: string, given: string | null): void {
  if (given === null) element.removeAttribute(attribute);
  else element.setAttribute(attribute, given);
}

/** What was set on an element before the module had come: as properties of its own they would hide those of the class. */
export function adoptEarly(element: Element): void {
  for (const name of [...Object.keys(REFLECTED), "viewpoint", "target"]) {
    const descriptor = Object.getOwnPropertyDescriptor(element, name);
    if (!descriptor) continue;
    // eslint-disable-next-line @typescript-eslint/no-dynamic-delete
    delete (element as unknown as Record<string, unknown>)[name];
    (element as unknown as Record<string, unknown>)[name] = descriptor.value;
  }
}

/** Three finite numbers. */
export function placeOf(given: ArrayLike<number>): [number, number, number] {
  const place = parsePlace(Array.from(given).join(","));
  if (!place) throw new TypeError("expected three finite numbers");
  return place;
}
