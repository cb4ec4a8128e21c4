// Reads the values of single arguments.
import { type ChosenColumns, isNumber } from "../formats/axes.js";

/** Wrong usage: the message says what is wrong. */
export class UsageProblem extends Error {}

export function readViewpoint(text: string): number[] {
  const numbers = text.split(",").map(numberIn);
  if (numbers.length !== 3 || !numbers.every(Number.isFinite)) {
    throw new UsageProblem(`--from needs three numbers, as in --from 1,2.5,-3, not ${text}`);
  }
  return numbers;
}

/** The size of images, as in 1920x1080. */
export function readSize(text: string): { width: number; height: number } {
  const [, width, height] = /^([1-9]\d*)x([1-9]\d*)$/.exec(text) ?? [];
  if (height === undefined) throw new UsageProblem(`--size needs two numbers, as in --size 1920x1080, not ${text}`);
  return { width: Number(width), height: Number(height) };
}

/** The value of an option of a view: a number, or else a word. KIND:VALUE is an object. The library checks it. */
export function readOption(name: string, text: string): unknown {
  if (name === "within") {
    if (!text.includes(",")) return { distance: readValue(text) };
    const numbers = text.split(",").map(numberIn);
    if (numbers.length !== 6 || numbers.some(Number.isNaN)) {
      throw new UsageProblem(`--within needs a distance, or six numbers, as in --within 0,0,0,1,1,1, not ${text}`);
    }
    return { box: [numbers.slice(0, 3), numbers.slice(3)] };
  }
  const colon = text.indexOf(":");
  return colon < 0 ? readValue(text) : { [text.slice(0, colon)]: readValue(text.slice(colon + 1)) };
}

function readValue(text: string): unknown {
  const value = numberIn(text);
  return Number.isNaN(value) ? text : value;
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
