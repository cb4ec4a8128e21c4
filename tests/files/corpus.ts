import type { ChosenColumns } from "../../src/ts/formats/axes";
import { FLAT } from "./valid";

/** A file with a named fault, and the expected result. */
export interface Case {
  name: string;
  file: string;
  content: Uint8Array;
  columns?: ChosenColumns;
  /** The points that must be read, or a part of the message that must refuse the file. */
  expected: readonly number[] | string;
}

/** A change of a text: a replacement of one part, or a function that returns the whole new text. */
export type Edit = readonly [from: string | RegExp, to: string] | ((text: string) => string);

export function edited(text: string, edit: Edit): string {
  const result = typeof edit === "function" ? edit(text) : text.replace(edit[0], edit[1]);
  if (result === text) throw new Error(`an edit changes nothing: ${String(edit)}`);
  return result;
}

/** The expected points are the same as without the fault. */
export const SAME = FLAT;

export const bytes = (...parts: (string | Uint8Array)[]) =>
  Buffer.concat(parts.map((part) => (typeof part === "string" ? Buffer.from(part) : part)));
