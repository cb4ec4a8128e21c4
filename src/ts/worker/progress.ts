import { listener } from "../query/options.js";

/** Tells a listener the progress of a task. The numbers only grow. */
export class Progress {
  readonly #listener: (fraction: number) => void;
  #last = -1;

  constructor(listener: (fraction: number) => void) {
    this.#listener = listener;
  }

  at(fraction: number): void {
    if (fraction > this.#last) {
      this.#last = fraction;
      // This runs in a task of its own: an error of the listener must not disturb the caller.
      queueMicrotask(() => {
        this.#listener(fraction);
      });
    }
  }
}

/** The option `onProgress`. */
export function readProgress(given: Record<string, unknown>): Progress | undefined {
  const told = listener(given, "onProgress");
  return told && new Progress(told as (fraction: number) => void);
}
