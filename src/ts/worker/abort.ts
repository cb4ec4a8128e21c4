import { describe, HprError } from "../errors.js";

export const BY_SIGNAL = "aborted by its signal";

/** What a promise is rejected with when its request was given up. */
export function abortError(why: string): DOMException {
  return new DOMException(why, "AbortError");
}

/** The promise's own outcome, unless the signal aborts before it is there. */
export async function untilAborted<T>(
  signal: AbortSignal | undefined,
  promise: Promise<T>,
): Promise<T> {
  if (signal === undefined) {
    return promise;
  }
  // Once aborted, nobody waits for it any more: its failure is no one's concern.
  promise.catch(() => undefined);
  let abort!: () => void;
  const aborted = new Promise<never>((_, reject) => {
    abort = () => {
      reject(abortError(BY_SIGNAL));
    };
  });
  signal.addEventListener("abort", abort, { once: true });
  try {
    if (signal.aborted) {
      abort();
    }
    return await Promise.race([aborted, promise]);
  } finally {
    signal.removeEventListener("abort", abort);
  }
}

/** The option `signal`: of this frame or another, or one that works alike. */
export function readSignal(signal: unknown): AbortSignal | undefined {
  if (signal === undefined) {
    return undefined;
  }
  if (typeof signal === "object" && signal !== null) {
    const like = signal as Partial<Record<keyof AbortSignal, unknown>>;
    if (
      typeof like.aborted === "boolean" &&
      typeof like.addEventListener === "function" &&
      typeof like.removeEventListener === "function"
    ) {
      return signal as AbortSignal;
    }
  }
  throw new HprError("option", `signal must be an AbortSignal, got ${describe(signal)}`);
}
