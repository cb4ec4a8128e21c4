import type { PreparedCloud } from "../cloud/cloud.ts";
import type { GeneratorName } from "../samples/generators.ts";
import type { FormatProblem } from "../../src/ts/formats/problem.js";

export type LoadRequest = { kind: "sample"; name: string; url: string } | WorkerRequest;

/** A request of the page to the loading worker. Each worker gets one request. */
export type WorkerRequest =
  | { kind: "shape"; name: string; shape: GeneratorName }
  | ({ kind: "url"; name: string; url: string } & ReadOptions)
  | ({ kind: "file"; name: string; file: File } & ReadOptions)
  | { kind: "files"; name: string; files: File[]; limit?: number };

export interface ReadOptions {
  skipNonFinite?: boolean;
  /** Whether a file that contradicts itself is read, and a table with lines that are no points. */
  damaged?: boolean;
  /** The columns of a table that are x, y and z. */
  chosen?: [string, string, string];
  /** If there are more points than this, the cloud is thinned evenly. */
  limit?: number;
}

/** The replies: any number of progress steps, then the cloud or an error. `fraction` is null if it is not known. */
export type LoadReply =
  | { kind: "progress"; step: string; fraction: number | null }
  | { kind: "cloud"; prepared: PreparedCloud }
  | { kind: "problem"; sentence: string; rest: Rest | undefined };

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
