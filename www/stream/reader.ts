import type { MergeOptions } from "hidden-point-removal";
import type { Streamed } from "../cloud/cloud.ts";
import type { Viewpoint } from "../settings/settings.ts";
import { LoadProblem } from "../loaders/protocol.ts";

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

/** What happens to a view. A step is followed by another one only after `next`. */
export interface ViewEvents {
  onStep: (step: StreamStep) => void;
  onEnd: () => void;
  onProblem: (error: LoadProblem) => void;
}

/** Reads an octree in its own worker, for one view at a time. */
export class OctreeReader {
  readonly #worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
  #turn = 0;
  #events: ViewEvents | null = null;

  constructor(streamed: Streamed) {
    this.#worker.onmessage = ({ data: reply }: MessageEvent<StreamReply>) => {
      if (reply.turn !== this.#turn || !this.#events) return;
      const { onStep, onEnd, onProblem } = this.#events;
      if (reply.kind === "step") onStep(reply.step);
      else if (reply.kind === "end") onEnd();
      else onProblem(new LoadProblem(reply.sentence));
    };
    this.#worker.onerror = (event) => {
      event.preventDefault();
      const why = "a part of this page could not be loaded, or the browser ran out of memory";
      this.#events?.onProblem(new LoadProblem(`${streamed.name} could not be read further: ${why}.`));
    };
    this.#tell({ kind: "open", streamed });
  }

  /** Begins a view, and gives up the one before. */
  view(view: StreamView, events: ViewEvents): void {
    this.#events = events;
    this.#tell({ kind: "view", turn: ++this.#turn, view });
  }

  next(): void {
    this.#tell({ kind: "next" });
  }

  stop(): void {
    if (!this.#events) return;
    this.#events = null;
    this.#tell({ kind: "stop" });
  }

  dispose(): void {
    this.#events = null;
    this.#worker.terminate();
  }

  #tell(told: StreamTold): void {
    this.#worker.postMessage(told);
  }
}
