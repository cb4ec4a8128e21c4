import { describe, HprError } from "../base/errors.js";

export const BY_SIGNAL = "aborted by its signal";

/** What a promise is rejected with when its request was given up. */
export function abortError(why: string): DOMException {
  return new DOMException(why, "AbortError");
}

/** The promise's own outcome, unless the signal aborts before it is there. */
export async function untilAborted<T>(signal: AbortSignal | undefined, promise: Promise<T>): Promise<T> {
  if (signal === undefined) {
    return promise;
  }
  // Once aborted, nobody waits for it any more: its failure is no one's concern.
  promise.catch(() => undefined);
  let forget = () => {};
  const aborted = new Promise<never>((_, reject) => {
    forget = whenAborted(signal, () => {
      reject(abortError(BY_SIGNAL));
    });
  });
  try {
    return await Promise.race([aborted, promise]);
  } finally {
    forget();
  }
}

interface Waiting {
  acts: Set<() => void>;
  listener: () => void;
}

/** Node takes a signal with more than ten listeners for a leak: whatever waits for one shares a listener. */
const waiting = new WeakMap<AbortSignal, Waiting>();

/** Acts when the signal aborts, or now if it has, until what is returned is called. */
function whenAborted(signal: AbortSignal, act: () => void): () => void {
  let entry = waiting.get(signal);
  if (entry === undefined) {
    const acts = new Set<() => void>();
    const listener = () => {
      for (const act of [...acts]) act();
    };
    signal.addEventListener("abort", listener);
    entry = { acts, listener };
    waiting.set(signal, entry);
  }
  const { acts, listener } = entry;
  acts.add(act);
  if (signal.aborted) {
    act();
  }
  return () => {
    acts.delete(act);
    if (acts.size === 0) {
      signal.removeEventListener("abort", listener);
      waiting.delete(signal);
    }
  };
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
