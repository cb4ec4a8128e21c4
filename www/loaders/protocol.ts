import type { PreparedCloud } from "../cloud/cloud.ts";
import type { Rest } from "./problem.ts";
import type { GeneratorName } from "../samples/generators.ts";

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
  /** An octree with more points than this is streamed: only its coarser levels are read now. */
  streamFrom?: number;
}

/** The replies: any number of progress steps, then the cloud or an error. `fraction` is null if it is not known. */
export type LoadReply =
  | { kind: "progress"; step: string; fraction: number | null }
  | { kind: "cloud"; prepared: PreparedCloud }
  | { kind: "problem"; sentence: string; rest: Rest | undefined };
