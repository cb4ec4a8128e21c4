import { describe, HprError } from "../errors.js";

/** What a promise is rejected with when its request was given up. */
export function abortError(why: string): DOMException {
  return new DOMException(why, "AbortError");
}

/** The promise's own outcome, unless the signal aborts before it is there. */
export function untilAborted<T>(signal: AbortSignal | undefined, promise: Promise<T>): Promise<T> {
  if (signal === undefined) {
    return promise;
  }
  return new Promise((resolve, reject) => {
    const abort = () => {
      reject(abortError("aborted by its signal"));
    };
    if (signal.aborted) {
      abort();
    }
    signal.addEventListener("abort", abort, { once: true });
    promise.then(resolve, reject).finally(() => {
      signal.removeEventListener("abort", abort);
    });
  });
}

/** The option `signal`. */
export function readSignal(signal: unknown): AbortSignal | undefined {
  if (
    signal === undefined ||
    (typeof signal === "object" &&
      signal !== null &&
      "aborted" in signal &&
      "addEventListener" in signal)
  ) {
    return signal as AbortSignal | undefined;
  }
  throw new HprError("option", `signal must be an AbortSignal, got ${describe(signal)}`);
}
