import type { FormatProblem } from "../../src/ts/formats/problem.js";

/** The way out of a problem: the end of "Load …", and the options with which the file is read again. */
export interface Rest {
  words: "without it" | "without them" | "anyway";
  with: { skipNonFinite: true } | { damaged: true };
}

/** An error for a file that cannot be shown. The user reads its message. */
export class LoadProblem extends Error {
  override readonly name = "LoadProblem";

  /** How the rest of the file could be loaded, and the options for that. */
  readonly rest: Rest | undefined;

  constructor(sentence: string, rest?: Rest) {
    super(sentence);
    this.rest = rest;
  }
}

/** The readers of formats are downloaded when they are needed, maybe long after the page. */
export function missingPart(name: string): LoadProblem {
  return new LoadProblem(`${name} could not be read: a part of this page could not be downloaded.`);
}

export function problemOf(name: string, { message, rest }: FormatProblem): LoadProblem {
  return new LoadProblem(`${name} cannot be read: ${message}.`, rest && { words: rest, with: { damaged: true } });
}
