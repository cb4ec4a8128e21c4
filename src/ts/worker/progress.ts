import { describe, HprError } from "../base/errors.js";

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
export function readProgress(listener: unknown): Progress | undefined {
  if (listener === undefined) {
    return undefined;
  }
  if (typeof listener !== "function") {
    throw new HprError("option", `onProgress must be a function, got ${describe(listener)}`);
  }
  return new Progress(listener as (fraction: number) => void);
}
