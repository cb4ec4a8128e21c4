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
