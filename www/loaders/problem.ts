import type { FormatProblem } from "../../src/ts/formats/problem.js";

/** A file that cannot be shown: the message is the sentence the user reads. */
export class LoadProblem extends Error {
  override readonly name = "LoadProblem";

  /** Points whose coordinates are not finite; the rest could be loaded without them. */
  readonly nonFinite: number;

  constructor(sentence: string, nonFinite = 0) {
    super(sentence);
    this.nonFinite = nonFinite;
  }
}

/** Formats are downloaded when they are needed, which may be long after the page. */
export function missingPart(name: string): LoadProblem {
  return new LoadProblem(`${name} could not be read: a part of this page could not be downloaded.`);
}

/** @param promised points, by the header of a LAS file */
export function endsEarly(name: string, promised: number): LoadProblem {
  return new LoadProblem(
    `${name} is broken: it ends before the ${promised.toLocaleString("en-US")} points its header promises.`,
  );
}

export function problemOf(name: string, { message }: FormatProblem): LoadProblem {
  return new LoadProblem(`${name} cannot be read: ${message}.`);
}
