// Reads the values of single arguments.
import { type ChosenColumns, isNumber } from "../formats/axes.js";
import type { RadiusRule, VisibilityOptions } from "../query/view-options.js";

/** Wrong usage: the message says what is wrong. */
export class UsageProblem extends Error {}

export function readViewpoint(text: string): number[] {
  const numbers = text.split(",").map(numberIn);
  if (numbers.length !== 3 || !numbers.every(Number.isFinite)) {
    throw new UsageProblem(`--from needs three numbers, as in --from 1,2.5,-3, not ${text}`);
  }
  return numbers;
}

export function readRadius(text: string): number | RadiusRule {
  if (text === "auto" || text === "opposite") return text;
  const radius = numberIn(text);
  if (!(radius > 0 && Number.isFinite(radius))) {
    throw new UsageProblem(`--radius needs a number above 0, auto or opposite, not ${text}`);
  }
  return radius;
}

/** Undefined for the automatic exponent. */
export function readExponent(text: string): number | undefined {
  if (text === "auto") return undefined;
  const value = numberIn(text);
  if (!(value >= 0 && Number.isFinite(value))) {
    throw new UsageProblem(`--exponent needs a number of 0 or more, or auto, not ${text}`);
  }
  return value;
}

export function readInversion(text: string): NonNullable<VisibilityOptions["inversion"]> {
  const [kind, word = "", ...more] = text.split(":");
  if (more.length === 0) {
    if (text === "spherical") return "spherical";
    if (text === "exponential:auto") return { exponential: "auto" };
    const parameter = numberIn(word);
    if (kind === "power" && parameter > 1 && parameter <= 16) return { power: parameter };
    if (kind === "exponential" && parameter > 0 && parameter < Infinity) return { exponential: parameter };
  }
  throw new UsageProblem(
    `--inversion needs spherical, power:G (above 1, at most 16), exponential:C (above 0) or exponential:auto, not ${text}`,
  );
}

/** 0: the operator alone. */
export function readLooks(text: string): 0 | 2 | 3 {
  const looks = ([0, 2, 3] as const).find((count) => String(count) === text);
  if (looks === undefined) throw new UsageProblem(`--looks needs 0, 2 or 3, not ${text}`);
  return looks;
}

export function oneOf<T extends string>(option: string, text: string | undefined, words: readonly T[]): T | undefined {
  const word = words.find((name) => name === text);
  if (text !== undefined && word === undefined) {
    throw new UsageProblem(`--${option} needs one of ${words.join(", ")}, not ${text}`);
  }
  return word;
}

/** @param option the name of the option, for the message */
export function readCount(option: string, text: string, most = Infinity): number {
  const count = /^\d+$/.test(text) ? Number(text) : 0;
  if (count < 1 || count > most) {
    throw new UsageProblem(
      `--${option} needs a whole number from 1${most < Infinity ? ` to ${most}` : ""}, not ${text}`,
    );
  }
  return count;
}

export function readThreshold(text: string): number {
  const threshold = numberIn(text);
  if (!(threshold >= 0 && threshold <= 1)) {
    throw new UsageProblem(`--score-threshold needs a number from 0 to 1, not ${text}`);
  }
  return threshold;
}

export function readColumns(text: string): ChosenColumns {
  const chosen = text.split(",").map((word) => word.trim());
  const isChoice = (word: string) => word !== "" && (isNumber(word) || !/^[-+]?\d+$/.test(word));
  if (chosen.length !== 3 || !chosen.every(isChoice) || new Set(chosen).size < 3) {
    throw new UsageProblem(`--columns needs three different columns, as in --columns 2,3,4, not ${text}`);
  }
  return chosen as unknown as ChosenColumns;
}

function numberIn(word: string): number {
  return word.trim() === "" ? NaN : Number(word);
}
