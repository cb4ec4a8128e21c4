// Options of clouds and views: single fields, and the contract's rules about fields that are used together.
import { inspect } from "node:util";
import fc from "fast-check";
import { type Argument, bad, good, JUNK, named, transferredAway } from "./argument.js";

interface Field {
  key: string;
  make: () => unknown;
  /** Codes of a refusal. Empty if the value is accepted. */
  codes: readonly string[];
  sure: boolean;
  /** The kind of the value, for the rules about several fields. */
  is?: "radius" | "rule" | "exponent" | "power" | "exponential";
}

export type Meaning = Readonly<Record<string, unknown>>;
export type Options = Argument<Meaning | undefined>;

const fine = (key: string, value: unknown, is?: Field["is"]): Field => ({
  key,
  make: () => value,
  codes: [],
  sure: false,
  ...(is && { is }),
});
const maybe = (code: string, key: string, value: unknown, is?: Field["is"]): Field => ({
  ...fine(key, value, is),
  codes: [code],
});
const wrong = (code: string, key: string, make: () => unknown, is?: Field["is"]): Field => ({
  ...fine(key, undefined, is),
  make,
  codes: [code],
  sure: true,
});

const WRAPPINGS: [name: string, wrap: (values: Meaning) => unknown][] = [
  ["an object", (values) => values],
  ["a frozen object", (values) => Object.freeze({ ...values })],
  ["an object without a prototype", (values) => Object.assign(Object.create(null) as object, values)],
  ["an heir", (values) => Object.create(values) as unknown],
  ["a proxy", (values) => new Proxy(values, {})],
  [
    "getters",
    (values) =>
      Object.defineProperties(
        {},
        Object.fromEntries(Object.entries(values).map(([key, value]) => [key, { get: () => value, enumerable: true }])),
      ),
  ],
];

const junkFor = (key: string, fits: (value: unknown) => boolean): Field[] =>
  JUNK.filter(([, make]) => make() !== undefined && !fits(make())).map(([, make]) => wrong("option", key, make));
const isNumber = (value: unknown) => typeof value === "number";

const RADIUS: Field[] = [
  fine("radius", 1e3, "radius"),
  fine("radius", 1e9, "radius"),
  maybe("radius", "radius", 7, "radius"),
  fine("radius", "auto"),
  fine("radius", "opposite", "rule"),
  ...[NaN, Infinity, -Infinity, 0, -0, -5, 1.7e308].map((x) => wrong("radius", "radius", () => x, "radius")),
  wrong("option", "radius", () => "search"),
  ...junkFor("radius", isNumber),
];
const EXPONENT: Field[] = [
  ...[0, 0.5, 2, 3.7].map((x) => fine("exponent", x, "exponent")),
  maybe("radius", "exponent", 400, "exponent"),
  ...[NaN, Infinity, -1].map((x) => wrong("option", "exponent", () => x, "exponent")),
  ...junkFor("exponent", isNumber),
];
const INVERSION: Field[] = [
  fine("inversion", "spherical"),
  ...[1.01, 2, 16].map((power) => fine("inversion", { power }, "power")),
  ...[0.1, 3, "auto"].map((exponential) => fine("inversion", { exponential }, "exponential")),
  ...[1, 0, 17, NaN, Infinity, "auto"].map((power) => wrong("option", "inversion", () => ({ power }))),
  ...[0, -1, NaN, Infinity, "far"].map((exponential) => wrong("option", "inversion", () => ({ exponential }))),
  ...[{}, { power: 2, exponential: 1 }, { gamma: 2 }, { power: 2, more: 1 }, []].map((it) =>
    wrong("option", "inversion", () => it),
  ),
  ...junkFor("inversion", () => false),
];
const UNKNOWN: Field[] = [
  wrong("option", "foo", () => 1),
  wrong("option", "draft", () => true),
  wrong("option", "Radius", () => 100),
  wrong("option", "dimension", () => 3),
];

/** Chooses a list, whatever its length, and then one of its values: a good value four times as often as a bad one. */
function oneOf(...lists: Field[][]): fc.Arbitrary<Field> {
  const groups = lists.flatMap((list) => [list.filter(({ sure }) => !sure), list.filter(({ sure }) => sure)]);
  return fc.oneof(
    ...groups
      .filter((group) => group.length > 0)
      .map((group) => ({ weight: group[0]!.sure ? 1 : 4, arbitrary: fc.constantFrom(...group) })),
  );
}

const view = oneOf(RADIUS, EXPONENT, INVERSION, UNKNOWN);

/** Options for a view from one viewpoint. */
export const viewOptions: fc.Arbitrary<Options> = together(view, () => []);

/** Options for a view along a direction. A power and the rule `opposite` are refused there. */
export const directionOptions: fc.Arbitrary<Options> = together(view, (fields) =>
  fields.filter(({ is }) => is === "power" || is === "rule").map(() => "option"),
);

const maxEdge: Field[] = [
  ...[0.5, 3, Infinity].map((x) => fine("maxEdge", x)),
  ...[NaN, -1, 0].map((x) => maybe("option", "maxEdge", x)),
  ...junkFor("maxEdge", isNumber),
];
export const reconstructionOptions: fc.Arbitrary<Options> = together(fc.oneof(view, oneOf(maxEdge)), () => []);

const light: Field[] = [
  ...[0, 1, 3].map((x) => fine("smoothing", x)),
  ...[-1, 1.5, 1001, NaN].map((x) => wrong("option", "smoothing", () => x)),
  ...junkFor("smoothing", isNumber),
  ...[0, 0.25, 1].map((x) => fine("ambient", x)),
  ...[-0.1, 1.1, NaN, Infinity].map((x) => wrong("option", "ambient", () => x)),
  ...junkFor("ambient", isNumber),
  fine("triangles", new Uint32Array(0)),
  maybe("option", "triangles", Uint32Array.of(0, 1, 2)),
  wrong("option", "triangles", () => new Uint32Array(2)),
  wrong("option", "triangles", () => Uint32Array.of(0, 1, 2 ** 32 - 1)),
  wrong("option", "triangles", () => transferredAway(new Uint32Array(3))),
  wrong("option", "triangles", () => [0, 1, 2]),
  ...junkFor("triangles", () => false),
];
export const illuminationOptions: fc.Arbitrary<Options> = together(fc.oneof(view, oneOf(light)), () => []);

/** Options with up to two fields. If both have the same name, the later one counts. */
function together(field: fc.Arbitrary<Field>, more: (fields: Field[]) => string[]): fc.Arbitrary<Options> {
  const options = fc
    .tuple(fc.array(field, { maxLength: 2 }), fc.constantFrom(...WRAPPINGS))
    .map(([all, [wrapping, wrap]]): Options => {
      const fields = [...new Map(all.map((one) => [one.key, one])).values()];
      const clashes = [...clash(fields), ...more(fields)];
      return {
        name: `${wrapping} with ${fields.map(({ key, make }) => `${key}: ${shown(make())}`).join(", ")}`,
        make: () => wrap(valuesOf(fields)),
        codes: [...fields.flatMap(({ codes }) => codes), ...clashes],
        sure: fields.some(({ sure }) => sure) || clashes.length > 0,
        meaning: valuesOf(fields),
      };
    });
  const none = fc.constant<Options>(good("no options", undefined));
  const junk = JUNK.filter(([, make]) => make() !== undefined).map(([name, make]) =>
    bad<Meaning | undefined>("option", `as options ${name}`, make, undefined),
  );
  return named(
    fc.oneof(
      { weight: 4, arbitrary: none },
      { weight: 10, arbitrary: options },
      // Maps, strings and the like are refused as options, because their contents would be ignored.
      { weight: 1, arbitrary: fc.constantFrom(...junk) },
    ),
  );
}

const valuesOf = (fields: Field[]) => Object.fromEntries(fields.map(({ key, make }) => [key, make()]));
const shown = (value: unknown) => inspect(value, { maxStringLength: 40, breakLength: Infinity });

/** The code for fields that exclude each other. */
function clash(fields: Field[]): string[] {
  const has = (is: Field["is"]) => fields.some((one) => one.is === is);
  const sized = fields.some(({ key }) => key === "radius") && has("exponent");
  const other = (has("exponent") || has("rule")) && (has("power") || has("exponential"));
  return sized || other || (has("radius") && has("exponential")) ? ["option"] : [];
}

export interface CloudShape {
  dimension: number;
  stride: number;
  skips: boolean;
}

/** Options that say how positions are read. For refused options, dimension and stride are 3. */
export const cloudShape: fc.Arbitrary<CloudShape & { options: Options }> = fc.oneof(
  {
    weight: 8,
    arbitrary: fc
      .record({
        dimension: fc.constantFrom(3, 3, 3, 3, 2, 2, 4, 5),
        more: fc.constantFrom(0, 0, 0, 1, 3),
        skips: fc.boolean(),
      })
      .map(({ dimension, more, skips }) => {
        const stride = dimension + more;
        const meaning: Meaning = {
          ...(dimension !== 3 && { dimension }),
          ...(more > 0 && { stride }),
          ...(skips && { nonFinite: "skip" }),
        };
        return { dimension, stride, skips, options: good<Meaning | undefined>(JSON.stringify(meaning), meaning) };
      }),
  },
  {
    weight: 1,
    arbitrary: together(
      fc.oneof(
        fc.constantFrom(
          ...[0, 1, -3, 65, 2.5, NaN, "3", null, {}].map((x) => wrong("option", "dimension", () => x)),
          ...[0, 2, -3, 3.5, NaN, 2 ** 32, "3", null].map((x) => wrong("option", "stride", () => x)),
          ...["ignore", true, null, 1].map((x) => wrong("option", "nonFinite", () => x)),
          ...[wrong("option", "strid", () => 4), wrong("option", "exponent", () => 2)],
        ),
      ),
      () => [],
    )
      .filter(({ sure }) => sure)
      .map((options) => ({ dimension: 3, stride: 3, skips: false, options })),
  },
);
