import type { MergeOptions } from "hidden-point-removal";
import type { Streamed } from "../cloud/cloud.ts";
import type { Viewpoint } from "../settings/settings.ts";

/** How a streamed octree is seen. */
export type StreamMethod = "automatic" | { length: number } | { exponential: number | "auto" };

/** The viewpoint and the method of one view of an octree. */
export interface StreamView {
  viewpoint: Viewpoint;
  method: StreamMethod;
}

/** What the page tells the worker. A view gives up the view before it. */
export type StreamTold =
  | { kind: "open"; streamed: Streamed }
  | { kind: "view"; turn: number; view: StreamView }
  | { kind: "next" }
  | { kind: "stop" };

/** What is known of a view so far. */
export interface StreamStep {
  /** x, y, z of all visible points of the nodes that were read. */
  positions: Float64Array<ArrayBuffer>;
  /** Red, green and blue of these points, in bytes. Null if the file has no colors. */
  colors: Uint8Array<ArrayBuffer> | null;
  exact: boolean;
  /** The numbers of nodes. */
  nodes: { read: number; hidden: number; undecided: number };
  /** The number of points that were read. */
  points: number;
  /** With it, all these points together have the same answer. */
  merge: MergeOptions;
}

/** What the worker answers. After each step it waits for `next`. */
export type StreamReply =
  | { kind: "step"; turn: number; step: StreamStep }
  | { kind: "end"; turn: number }
  | { kind: "problem"; turn: number; sentence: string };
