import type { Reply, Told } from "./protocol.ts";

/** The number of points in one message. Copying them takes a fraction of a frame. */
const PIECE = 250_000;

/** The page's side: a worker with the cloud and a reference, which is asked one question at a time. */
export class Reference<Question, Answer> {
  onProgress: (fraction: number) => void = () => undefined;
  readonly #worker: Worker;
  readonly #sent: Promise<void>;
  #waiting: { resolve: (answer: Answer | null) => void; reject: (error: Error) => void } | null = null;
  #ended = false;

  constructor(worker: Worker, positions: Float32Array) {
    this.#worker = worker;
    worker.onmessage = ({ data: reply }: MessageEvent<Reply<Answer>>) => {
      if (reply.kind === "progress") this.onProgress(reply.fraction);
      else if (reply.kind === "answer") this.#settle()?.resolve(reply.answer);
      else if (reply.kind === "stopped") this.#settle()?.resolve(null);
      else this.#settle()?.reject(new Error(reply.sentence));
    };
    worker.onerror = (event) => {
      event.preventDefault();
      this.#settle()?.reject(
        new Error(
          event instanceof ErrorEvent
            ? "the browser ran out of memory or stopped it"
            : "a part of this page could not be loaded",
        ),
      );
    };
    this.#sent = this.#send(positions);
  }

  /** `null` if the computation was stopped. */
  async ask(question: Question): Promise<Answer | null> {
    await this.#sent;
    if (this.#ended) return null;
    return new Promise((resolve, reject) => {
      this.#waiting = { resolve, reject };
      this.#tell({ kind: "ask", question });
    });
  }

  stop(): void {
    this.#tell({ kind: "stop" });
  }

  dispose(): void {
    this.#ended = true;
    this.#worker.terminate();
    this.#settle()?.resolve(null);
  }

  async #send(positions: Float32Array): Promise<void> {
    for (let at = 0; at < positions.length && !this.#ended; at += 3 * PIECE) {
      const points = positions.slice(at, at + 3 * PIECE);
      this.#tell({ kind: "points", count: positions.length / 3, at, points }, [points.buffer]);
      await new Promise((resolve) => setTimeout(resolve));
    }
  }

  #tell(told: Told<Question>, transfer: Transferable[] = []): void {
    this.#worker.postMessage(told, transfer);
  }

  #settle() {
    const waiting = this.#waiting;
    this.#waiting = null;
    return waiting;
  }
}

/** The error in words, with one full stop at the end. */
export function sentenceOf(error: unknown): string {
  return `${(error instanceof Error ? error.message : String(error)).replace(/\.$/, "")}.`;
}
