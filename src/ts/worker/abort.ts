import { describe, HprError } from "../base/errors.js";

/** What rejects a promise when its signal aborts: what `abort(reason)` was given, or an `AbortError`. */
export function reasonOf(signal: AbortSignal): unknown {
  return signal.reason === undefined ? abortError("aborted by its signal") : signal.reason;
}

/** The error that rejects a promise when its request was given up. */
export function abortError(why: string): DOMException {
  return new DOMException(why, "AbortError");
}

/** The outcome of the promise. If the signal aborts earlier, its reason rejects it. */
export async function untilAborted<T>(signal: AbortSignal | undefined, promise: Promise<T>): Promise<T> {
  if (signal === undefined) {
    return promise;
  }
  // After the abort, nobody waits for the promise any more, so nobody needs to hear of its failure.
  promise.catch(() => undefined);
  let forget = () => {};
  const aborted = new Promise<never>((_, reject) => {
    forget = whenAborted(signal, () => {
      // oxlint-disable-next-line typescript/prefer-promise-reject-errors -- the caller's reason may be anything
      reject(reasonOf(signal));
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

/**
 * Node warns of a leak when a signal has more than ten listeners. So all that wait for one signal
 * share one listener.
 */
const waiting = new WeakMap<AbortSignal, Waiting>();

/**
 * Acts when the signal aborts, or now if it has aborted already. The returned function stops the
 * waiting.
 */
export function whenAborted(signal: AbortSignal, act: () => void): () => void {
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

/** The option `signal`. It may come from another frame, or be an object that works like one. */
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
