import type { Streamed } from "../cloud/cloud.ts";
import { LoadProblem } from "../loaders/problem.ts";
import type { StreamReply, StreamStep, StreamTold, StreamView } from "./protocol.ts";

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
