import type { WorkerCloud } from "./worker-cloud.ts";

/**
 * The same cloud in another worker, for questions that take many hulls: they do not delay the other questions. A worker
 * cannot be stopped within a question. So an overtaken question goes on there, and its answer is dropped. The worker is
 * made when it is needed.
 */
export class SecondCloud {
  readonly #make: () => Promise<WorkerCloud>;
  #made: Promise<WorkerCloud> | null = null;
  #disposed = false;

  constructor(make: () => Promise<WorkerCloud>) {
    this.#make = make;
  }

  /** Rejects with an AbortError if the signal aborts before the cloud is ready. */
  async ready(signal?: AbortSignal): Promise<WorkerCloud> {
    if (this.#disposed) throw new DOMException("Another cloud is shown.", "AbortError");
    if (!this.#made) {
      this.#made = this.#make();
      // If it could not be made, the next question tries again.
      this.#made.catch(() => {
        this.#made = null;
      });
    }
    if (!signal) return this.#made;
    const aborted = new Promise<never>((_, reject) => {
      signal.addEventListener("abort", () => {
        reject(signal.reason as DOMException);
      });
    });
    return Promise.race([this.#made, aborted]);
  }

  dispose(): void {
    this.#disposed = true;
    void this.#made?.then(
      ({ points }) => points.dispose(),
      () => undefined,
    );
  }
}
