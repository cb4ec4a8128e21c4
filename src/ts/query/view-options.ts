import { allocating, describe, HprError } from "../base/errors.js";
import { type OneWay, VIEW_ROWS, type VisibilityOptions } from "./option-rows.js";
import type { Inversion, RadiusRule, ResolvedInversion, Within, Without } from "./option-types.js";
import { type Checked, checkRows, entriesOf, number, requireLow } from "./options.js";
import { plainView, typedArrayType } from "../base/typed-arrays.js";
import { listed } from "./positions.js";

export type { Within };

/** {@link Within}, checked for type, as the core reads it. */
export interface WithinSettings {
  /** The distance, and the lowest and the highest coordinates. Infinity stands for none. */
  within: readonly number[];
  mask: Uint8Array<ArrayBuffer> | undefined;
}

export const ALL_POINTS: WithinSettings = { within: numbers(), mask: undefined };

/** Reads the option `within`. The core checks the ranges. */
export function withinSettings(within: unknown, dimension: number): WithinSettings {
  if (within === undefined) {
    return ALL_POINTS;
  }
  requireLow("within", dimension);
  const given = entriesOf("within", within, ["distance", "box", "mask"]);
  const distance = number(given, "distance");
  const { box, mask } = given;
  return {
    within: numbers(distance, box === undefined ? undefined : readBox(box, dimension)),
    mask: mask === undefined ? undefined : readMask(mask),
  };
}

function numbers(distance = Infinity, { min, max }: { min: number[]; max: number[] } = { min: [], max: [] }): number[] {
  // A missing coordinate, also the z of a plane, has no limit.
  const fill = (corner: number[], limit: number) => [0, 1, 2].map((axis) => corner[axis] ?? limit);
  return [distance, ...fill(min, -Infinity), ...fill(max, Infinity)];
}

function readBox(box: unknown, dimension: number): { min: number[]; max: number[] } {
  const [min, max] = (listOf(box, 2) ?? []).map((corner) => listOf(listed(corner, dimension), dimension));
  const areNumbers = (list?: unknown[]): list is number[] => list?.every((x) => typeof x === "number") === true;
  if (!areNumbers(min) || !areNumbers(max)) {
    throw new HprError("option", `within box must be [min, max], each with ${dimension} numbers, got ${describe(box)}`);
  }
  return { min, max };
}

/** The entries of a list of this length: nothing is read of a longer one, or of one whose memory is gone. */
function listOf(value: unknown, length: number): unknown[] | undefined {
  if (typeof value !== "object" || value === null || !("length" in value) || value.length !== length) return undefined;
  return Array.from({ length }, (_, i) => (value as ArrayLike<unknown>)[i]);
}

/** A copy, so that later changes do not concern a request that waits. The core checks the length. */
function readMask(mask: unknown): Uint8Array<ArrayBuffer> {
  const bytes = typedArrayType(mask) === "Uint8Array" ? plainView(mask as Uint8Array, Uint8Array) : undefined;
  if (bytes === undefined) {
    throw new HprError("option", `within mask must be a Uint8Array, not transferred away, got ${describe(mask)}`);
  }
  return allocating(`a mask of ${bytes.length} bytes`, () => bytes.slice());
}

export type { Inversion, OneWay, RadiusRule, ResolvedInversion, VisibilityOptions };

/**
 * The options of a view that has looks of its own. Without `radius`, `exponent`, `inversion` and `looks`, `thickness`
 * and `surface` belong to these looks.
 */
export type FollowedOptions =
  | VisibilityOptions
  | (Without<"radius" | "exponent" | "inversion" | "looks" | "scores"> &
      Pick<VisibilityOptions, "thickness" | "surface" | "within">);

/** {@link VisibilityOptions}, checked for type, as the core reads them (src/wasm/options.rs). */
export interface ViewSettings extends WithinSettings {
  /** A number of {@link Rule}. */
  rule: number;
  /** R or the exponent, if one is given. */
  size: number;
  /** A number of {@link Kernel}. */
  kernel: number;
  /** γ or c, if one is given, or the number of looks. */
  parameter: number;
  /** All others that were given. The core reads them by name. */
  others: readonly (readonly [name: string, value: unknown])[];
}

export const Rule = { auto: 0, opposite: 1, radius: 2, exponent: 3 } as const;
export const Kernel = { spherical: 0, power: 1, automaticExponential: 2, exponential: 3, looks: 4 } as const;

export const VIEW_OPTIONS = Object.keys(VIEW_ROWS);
const OTHERS = VIEW_OPTIONS.filter((name) => !["radius", "exponent", "inversion", "looks", "within"].includes(name));

/** The options of a view, or of a question that has more. */
type Given = Checked<VisibilityOptions, typeof VIEW_ROWS>;

/** Reads the options and checks their types. The core checks the ranges, since it knows the distances. */
export function viewSettings(given: object, dimension: number): ViewSettings {
  checkRows(given as Record<string, unknown>, VIEW_ROWS, dimension);
  const { inversion, looks, within, ...more } = given as Given & Record<string, unknown>;
  return {
    ...chosenRadius(given),
    ...(looks === undefined ? chosenInversion(inversion) : { kernel: Kernel.looks, parameter: looks }),
    others: OTHERS.filter((name) => Object.hasOwn(more, name)).map((name) => [name, more[name]] as const),
    ...withinSettings(within, dimension),
  };
}

/** Whether the answer has scores. */
export function hasScores({ others }: ViewSettings): boolean {
  return others.some(([name, value]) => name === "scores" && value === true);
}

/** The settings of a view without options. */
export const NO_OPTIONS: ViewSettings = {
  rule: Rule.auto,
  size: 0,
  kernel: Kernel.spherical,
  parameter: 0,
  others: [],
  ...ALL_POINTS,
};

/** The rule of `autoRadius`, as settings. */
export function ruleSettings(rule: unknown): ViewSettings {
  if (rule !== undefined && !isRule(rule)) {
    throw new HprError("option", `the rule must be "auto" or "opposite", got ${describe(rule)}`);
  }
  return { ...NO_OPTIONS, rule: Rule[rule ?? "auto"] };
}

/** The inversion in the answer to a view with these settings. `scales` are the values of c that were used. */
export function resolvedInversion({ kernel, parameter }: ViewSettings, scales: readonly number[]): ResolvedInversion {
  switch (kernel) {
    case Kernel.power:
      return { power: parameter };
    case Kernel.automaticExponential:
    case Kernel.exponential:
      return { exponential: scales[0]! };
    case Kernel.looks:
      return { looks: scales.slice(0, parameter) };
    default:
      return "spherical";
  }
}

export function chosenRadius({ radius, exponent }: Pick<Given, "radius" | "exponent">) {
  if (exponent !== undefined) {
    return { rule: Rule.exponent, size: exponent };
  }
  return typeof radius === "number" ? { rule: Rule.radius, size: radius } : { rule: Rule[radius ?? "auto"], size: 0 };
}

export function chosenInversion(inversion: unknown): Pick<ViewSettings, "kernel" | "parameter"> {
  if (inversion === undefined || inversion === "spherical") {
    return { kernel: Kernel.spherical, parameter: 0 };
  }
  if (typeof inversion !== "object") {
    throw new HprError(
      "option",
      `inversion must be "spherical", { power } or { exponential }, got ${describe(inversion)}`,
    );
  }
  const { power, exponential } = entriesOf("inversion", inversion, ["power", "exponential"]);
  if ((power === undefined) === (exponential === undefined)) {
    throw new HprError("option", "inversion must have one of power and exponential");
  }
  if (typeof power === "number") {
    return { kernel: Kernel.power, parameter: power };
  }
  if (power !== undefined) {
    throw new HprError("option", `inversion power must be a number, got ${describe(power)}`);
  }
  if (exponential === "auto") {
    return { kernel: Kernel.automaticExponential, parameter: 0 };
  }
  if (typeof exponential !== "number") {
    throw new HprError("option", `inversion exponential must be a number or "auto", got ${describe(exponential)}`);
  }
  return { kernel: Kernel.exponential, parameter: exponential };
}

/** Refuses what a question of several views does not give. */
export function refuseScores({ scores }: { scores?: unknown }, question: string): void {
  if (scores !== undefined && scores !== false) {
    throw new HprError("option", `scores cannot be combined with ${question}`);
  }
}

function isRule(value: unknown): value is RadiusRule {
  return value === "auto" || value === "opposite";
}
