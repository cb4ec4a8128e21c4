import type { WorkerCloud } from "./worker-cloud.ts";

/**
 * The same cloud in another worker, for questions of many hulls: what comes up meanwhile is not held up by them. A worker
 * cannot be stopped within a question, so one that has been overtaken goes on there, heard by nobody. Made when it is needed.
 */
export class SecondCloud {
  readonly #make: () => Promise<WorkerCloud>;
  #made: Promise<WorkerCloud> | null = null;
  #disposed = false;

  constructor(make: () => Promise<WorkerCloud>) {
    this.#make = make;
  }

  /** Rejects with an AbortError when the signal aborts before it is there. */
  async ready(signal: AbortSignal): Promise<WorkerCloud> {
    if (this.#disposed) throw new DOMException("Another cloud is shown.", "AbortError");
    if (!this.#made) {
      this.#made = this.#make();
      // Where it could not be made, the next question tries again.
      this.#made.catch(() => {
        this.#made = null;
      });
    }
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
