import type { Box, Classes, Inversion, Radius, Viewpoint } from "./limits.ts";

/** A kind of value: how it is written as text, in the address and in attributes. */
export interface Kind<T> {
  /** `undefined` for a text that cannot be used. */
  parse: (text: string) => T | undefined;
  write: (value: T) => string;
  /** Describes the texts that can be used. A literal text is in backticks. */
  values: string;
}

/** One of several words. */
export function oneOf<T extends string>(...words: T[]): Kind<T> {
  const quoted = words.map((word) => `\`${word}\``);
  return {
    parse: (text) => words.find((word) => word === text),
    write: String,
    values: `${quoted.slice(0, -1).join(", ")} or ${quoted.at(-1)!}`,
  };
}

/** One of several numbers. */
export function oneNumberOf<T extends number>(...numbers: T[]): Kind<T> {
  const { values } = oneOf(...numbers.map(String));
  return { parse: (text) => numbers.find((number) => String(number) === text), write: String, values };
}

function numberThat(isUsable: (value: number) => boolean, values: string): Kind<number> {
  const parse = (text: string) => {
    const value = parseNumber(text);
    return isUsable(value) ? value : undefined;
  };
  return { parse, write: String, values };
}

export function between(least: number, most: number, what = "a number"): Kind<number> {
  return numberThat((value) => value >= least && value <= most, `${what} from ${least} to ${most}`);
}

export function wholeBetween(least: number, most: number): Kind<number> {
  const isUsable = (value: number) => Number.isInteger(value) && value >= least && value <= most;
  return numberThat(isUsable, `an integer from ${least} to ${most}`);
}

/** A kind that is `null` unless it is given. */
export function orNone<T>({ parse, write, values }: Kind<T>): Kind<T | null> {
  return { parse, write: (value) => (value === null ? "" : write(value)), values };
}

/** A kind that takes one more word as a value. */
export function orWord<T, Word extends string | number>(
  { parse, write, values }: Kind<T>,
  word: string,
  meaning: Word,
): Kind<T | Word> {
  return {
    parse: (text) => (text === word ? meaning : parse(text)),
    write: (value) => (value === meaning ? word : write(value as T)),
    values: `${values} or \`${word}\``,
  };
}

export const POSITIVE = numberThat((value) => value > 0 && value < Infinity, "a positive number");

/** x, y, z in the file's own coordinates. */
export const PLACE: Kind<Viewpoint> = {
  parse: (text) => {
    const numbers = text.split(",").map(parseNumber);
    return numbers.length === 3 && numbers.every(Number.isFinite) ? (numbers as Viewpoint) : undefined;
  },
  write: String,
  values: "three numbers `x,y,z`",
};

/** The lower corner of a box, then the upper one. */
export const BOX: Kind<Box> = {
  parse: (text) => {
    const numbers = text.split(",");
    const [low, high] = [PLACE.parse(numbers.slice(0, 3).join()), PLACE.parse(numbers.slice(3).join())];
    return low && high && low.every((value, axis) => value <= high[axis]!) ? [low, high] : undefined;
  },
  write: String,
  values: "six numbers: the lower corner of a box, then the upper one",
};

/** The name of a column, and the classes of it. */
export const CLASSES: Kind<Classes> = {
  parse: (text) => {
    const [, column, list] = /^(.+):([^:]+)$/.exec(text) ?? [];
    const values = (list ?? "").split(",").map(parseNumber);
    return column && values.every(Number.isFinite) ? { column, values } : undefined;
  },
  write: ({ column, values }) => `${column}:${values.join()}`,
  values: "the name of a column and numbers, as in `classification:2,6`",
};

/** Any text. Only after the cloud is loaded is it known whether the cloud has something of that name. */
export const NAME: Kind<string> = { parse: (text) => text, write: String, values: "a name" };

/** Automatic, or a length. A radius that is given by its exponent is written by another parameter. */
export const RADIUS: Kind<Radius> = {
  parse: (text) => {
    if (text === "auto") return { rule: "auto" };
    const length = POSITIVE.parse(text);
    return length === undefined ? undefined : { length };
  },
  write: (radius) => ("rule" in radius ? radius.rule : "length" in radius ? String(radius.length) : ""),
  values: "`auto` or a positive number",
};

/** A word. Its parameter may follow after a colon. */
export const INVERSION: Kind<Inversion> = {
  parse: (text) => {
    const [word, parameter, ...more] = text.split(":");
    if (more.length > 0) return undefined;
    const value = parameter === undefined ? "auto" : parseNumber(parameter);
    if (word === "spherical" && parameter === undefined) return "spherical";
    if (word === "exponential" && (value === "auto" || (value > 0 && value < Infinity))) return { exponential: value };
    return undefined;
  },
  write: (inversion) => {
    if (inversion === "spherical") return inversion;
    const { exponential } = inversion;
    return exponential === "auto" ? "exponential" : `exponential:${exponential}`;
  },
  values: "`spherical`, `exponential` or `exponential:c` with a positive c",
};

/** Like `Number`, but an empty text gives no number. */
function parseNumber(text: string): number {
  return text.trim() === "" ? NaN : Number(text);
}
