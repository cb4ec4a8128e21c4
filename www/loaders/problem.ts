import type { FormatProblem } from "../../src/ts/formats/problem.js";

/** An error for a file that cannot be shown. The user reads its message. */
export class LoadProblem extends Error {
  override readonly name = "LoadProblem";

  /** The number of points whose coordinates are not finite. The other points could be loaded without them. */
  readonly nonFinite: number;

  constructor(sentence: string, nonFinite = 0) {
    super(sentence);
    this.nonFinite = nonFinite;
  }
}

/** The readers of formats are downloaded when they are needed, maybe long after the page. */
export function missingPart(name: string): LoadProblem {
  return new LoadProblem(`${name} could not be read: a part of this page could not be downloaded.`);
}

export function problemOf(name: string, { message }: FormatProblem): LoadProblem {
  return new LoadProblem(`${name} cannot be read: ${message}.`);
}
