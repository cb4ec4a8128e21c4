import { describe, HprError } from "../base/errors.js";

/** Tells a listener of the caller how far something has come, in numbers that only grow. */
export class Progress {
  readonly #listener: (fraction: number) => void;
  #last = -1;

  constructor(listener: (fraction: number) => void) {
    this.#listener = listener;
  }

  at(fraction: number): void {
    if (fraction > this.#last) {
      this.#last = fraction;
      // By itself: what it throws is the caller's error and must not disturb this.
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
