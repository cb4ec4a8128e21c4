import { describe, HprError, naming, typeTag } from "../base/errors.js";

/** How the positions of a cloud are read. */
export interface PointCloudOptions {
  /**
   * The number of coordinates of a point, from 2 to 64. Use 2 for clouds in a plane. Answers
   * are as exact as with 3. From 4 on, the cloud has double precision. Default 3.
   */
  dimension?: number | undefined;
  /**
   * How many numbers there are from the start of one point to the start of the next. This is at
   * least the dimension. The numbers after a point's coordinates are skipped. Default: the
   * dimension.
   */
  stride?: number | undefined;
  /**
   * How to treat points with a NaN or infinite coordinate. `"error"` refuses the cloud. `"skip"`
   * keeps their indices, but these points are never visible and hide nothing. Default `"error"`.
   */
  nonFinite?: "error" | "skip" | undefined;
}

/** Options of a cloud, checked and complete. */
export interface CloudSettings {
  dimension: number;
  stride: number;
  skipNonFinite: boolean;
}

/** The public properties of a cloud that change with its points. */
export interface CloudSize {
  length: number;
  skipped: number;
  spacing: number;
}

export const CLOUD_OPTIONS = ["dimension", "stride", "nonFinite"] as const;

/** A larger stride would not fit into the core's memory. */
const MAX_STRIDE = 2 ** 32 - 1;
const MAX_DIMENSION = 64;

/**
 * Returns the options that were given, without those that are `undefined`. Refuses a name that is
 * in none of the groups. The returned object has no prototype, so it has no properties besides
 * the given options.
 */
export function givenOptions(options: unknown, ...groups: readonly (readonly string[])[]): Record<string, unknown> {
  const given = Object.create(null) as Record<string, unknown>;
  if (options === undefined) {
    return given;
  }
  // The tag refuses arrays, maps, promises and similar objects: their contents would be ignored.
  if (typeof options !== "object" || options === null || typeTag(options) !== "Object") {
    throw new HprError("option", `the options must be a plain object, got ${describe(options)}`);
  }
  const known = groups.flat();
  for (const name of namesIn(options, known)) {
    const value: unknown = Reflect.get(options, name);
    if (value === undefined) {
      continue;
    }
    if (typeof name === "symbol" || !known.includes(name)) {
      throw new HprError("option", `unknown option ${describe(name)}; known are ${known.join(", ")}`);
    }
    given[name] = value;
  }
  return given;
}

/** The entries of an option that is an object. Errors name the option. */
export function entriesOf(option: string, value: unknown, names: readonly string[]): Record<string, unknown> {
  return naming(option, () => givenOptions(value, names));
}

/**
 * The names that an object and its prototypes define: the known names, and all others that are
 * enumerable. The names that `Object.prototype` defines are left out: every object inherits them,
 * and no caller means them.
 */
function namesIn(options: object, known: readonly string[]): Set<string | symbol> {
  const names = new Set<string | symbol>();
  let level: object | null = options;
  while (level !== null) {
    const next = Object.getPrototypeOf(level) as object | null;
    // This also recognizes the `Object.prototype` of another frame.
    if (next === null && Object.hasOwn(level, "isPrototypeOf")) {
      break;
    }
    for (const name of Reflect.ownKeys(level)) {
      const isKnown = typeof name === "string" && known.includes(name);
      if (isKnown || Object.prototype.propertyIsEnumerable.call(level, name)) {
        names.add(name);
      }
    }
    level = next;
  }
  return names;
}

/** A property of an object that need not be plain. What somebody added to `Object.prototype` is none. */
export function ownOf(value: object, name: string): unknown {
  return name in Object.prototype && !Object.hasOwn(value, name) ? undefined : Reflect.get(value, name);
}

/** The given options whose names are in one group. */
export function pick(given: Record<string, unknown>, names: readonly string[]): Record<string, unknown> {
  const picked = Object.create(null) as Record<string, unknown>;
  for (const name of names) {
    picked[name] = given[name];
  }
  return picked;
}

export function cloudSettings(given: Record<string, unknown>, mostDimensions = MAX_DIMENSION): CloudSettings {
  const dimension = integer(given, "dimension", 2, mostDimensions) ?? 3;
  const stride = integer(given, "stride", dimension, MAX_STRIDE) ?? dimension;
  const { nonFinite = "error" } = given;
  if (nonFinite !== "error" && nonFinite !== "skip") {
    throw new HprError("option", `nonFinite must be "error" or "skip", got ${describe(nonFinite)}`);
  }
  return { dimension, stride, skipNonFinite: nonFinite === "skip" };
}

/** What an option may be: a row of the table of options (src/options.json). Without any of these, a reader of its own knows. */
export interface Row {
  readonly number?: { readonly least?: number; readonly above?: number; readonly most?: number };
  readonly words?: readonly string[];
  readonly whole?: readonly [least: number, most: number];
  readonly truth?: boolean;
  readonly call?: boolean;
  readonly space?: boolean;
  readonly needs?: string | undefined;
  readonly excludes?: readonly string[];
}

export type Rows = Readonly<Record<string, Row>>;

/** Options that their rows have checked. Those with readers of their own are unknown still. */
export type Checked<Options, Table extends Rows> = {
  [Name in keyof Options]: Name extends keyof Table
    ? Table[Name] extends { number: object } | { words: object } | { whole: object } | { truth: true } | { call: true }
      ? Options[Name]
      : unknown
    : unknown;
};

/** Reads the options of a question: their names, and all that their rows say. */
export function readOptions(
  options: unknown,
  rows: Rows,
  dimension: number,
  others: readonly string[] = [],
): Record<string, unknown> {
  const given = givenOptions(options, Object.keys(rows), others);
  checkRows(given, rows, dimension);
  return given;
}

/** Refuses options that their rows do not allow. */
export function checkRows(given: Record<string, unknown>, rows: Rows, dimension: number): void {
  for (const [name, row] of Object.entries(rows)) {
    const value = given[name];
    if (value === undefined) continue;
    if (!fits(row, value)) {
      throw new HprError("option", `${name} must be ${wanted(row)}, got ${describe(value)}`);
    }
    if (value === false && row.truth) continue;
    const other = row.excludes?.find((one) => given[one] !== undefined);
    if (other !== undefined) {
      throw new HprError("option", `${name} and ${other} exclude each other; give one of the two`);
    }
    if (row.needs !== undefined && given[row.needs] === undefined) {
      throw new HprError("option", `${name} can be given only with ${row.needs}`);
    }
    if (row.space) requireSpace(name, dimension);
  }
}

function fits({ number, words, whole, truth, call }: Row, value: unknown): boolean {
  if (truth) return typeof value === "boolean";
  if (call) return typeof value === "function";
  if (whole) return Number.isInteger(value) && (value as number) >= whole[0] && (value as number) <= whole[1];
  if (!number && !words) return true;
  if (words?.includes(value as string)) return true;
  if (!number || typeof value !== "number") return false;
  const { least = -Infinity, above = -Infinity, most = Infinity } = number;
  const isFree = number.least === undefined && number.above === undefined;
  return isFree || (value >= least && value > above && value <= most && value < Infinity);
}

/** What an option must be, for messages. */
function wanted({ number, words = [], whole, truth, call }: Row): string {
  if (truth) return "true or false";
  if (call) return "a function";
  if (whole) return `an integer from ${whole[0]} to ${whole[1]}`;
  const said = words.map((word) => JSON.stringify(word));
  if (number) {
    const { least, above, most } = number;
    const from = least !== undefined ? `, at least ${least}` : above !== undefined ? `, above ${above}` : "";
    const range = `${from}${most === undefined ? "" : ` and at most ${most}`}`;
    said.unshift(range === "" ? "a number" : `a finite number${range}`);
  }
  const last = said.pop()!;
  return said.length === 0 ? last : `${said.join(", ")} or ${last}`;
}

/** Refuses an option or method that works only in three dimensions. The message is the crate's. */
export function requireSpace(what: string, dimension: number): void {
  if (dimension !== 3) {
    throw new HprError("option", `${what} needs a cloud of dimension 3, not ${dimension}`);
  }
}

/** Refuses an option or method that needs at most three dimensions. The message is the crate's. */
export function requireLow(what: string, dimension: number): void {
  if (dimension > 3) {
    requireSpace(what, dimension);
  }
}

/** An option that is an integer in a range, if it was given. */
export function integer(given: Record<string, unknown>, name: string, least: number, most: number): number | undefined {
  const value = given[name];
  if (value === undefined) {
    return undefined;
  }
  if (!Number.isInteger(value) || (value as number) < least || (value as number) > most) {
    throw new HprError("option", `${name} must be an integer from ${least} to ${most}, got ${describe(value)}`);
  }
  return value as number;
}

/** An option that is a number, if it was given. The core checks its range. */
export function number(given: Record<string, unknown>, name: string): number | undefined {
  const value = given[name];
  if (value !== undefined && typeof value !== "number") {
    throw new HprError("option", `${name} must be a number, got ${describe(value)}`);
  }
  return value;
}

/** An option that is true or false. It is false if it was not given. */
export function flag(given: Record<string, unknown>, name: string): boolean {
  const value = given[name] ?? false;
  if (typeof value !== "boolean") {
    throw new HprError("option", `${name} must be true or false, got ${describe(value)}`);
  }
  return value;
}

/** An option that is a function, if it was given. */
export function listener(given: Record<string, unknown>, name: string): ((told: never) => void) | undefined {
  const value = given[name];
  if (value !== undefined && typeof value !== "function") {
    throw new HprError("option", `${name} must be a function, got ${describe(value)}`);
  }
  return value as ((told: never) => void) | undefined;
}

/** An option that is one of some words. */
export function word<T extends string>(
  given: Record<string, unknown>,
  name: string,
  words: readonly T[],
): T | undefined {
  const value = given[name];
  if (value !== undefined && !words.includes(value as T)) {
    throw new HprError("option", `${name} must be one of ${words.join(", ")}, got ${describe(value)}`);
  }
  return value as T | undefined;
}
