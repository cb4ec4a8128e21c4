import type { ChosenColumns } from "../../src/ts/formats/axes";
import { FLAT } from "./valid";

/** A file with a named fault, and what has to come of it. */
export interface Case {
  name: string;
  file: string;
  content: Uint8Array;
  columns?: ChosenColumns;
  /** The points that are read, or a part of the sentence that refuses the file. */
  expected: readonly number[] | string;
}

/** A change of a text: what is replaced by what, or how the whole is written anew. */
export type Edit = readonly [from: string | RegExp, to: string] | ((text: string) => string);

export function edited(text: string, edit: Edit): string {
  const result = typeof edit === "function" ? edit(text) : text.replace(edit[0], edit[1]);
  if (result === text) throw new Error(`an edit changes nothing: ${String(edit)}`);
  return result;
}

/** The same points as without the fault. */
export const SAME = FLAT;

export const bytes = (...parts: (string | Uint8Array)[]) =>
  Buffer.concat(parts.map((part) => (typeof part === "string" ? Buffer.from(part) : part)));
