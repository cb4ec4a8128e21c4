import { asError, HprError } from "../base/errors.js";
import { abortError, BY_SIGNAL, untilAborted, whenAborted } from "../worker/abort.js";

/** The part of `fetch` that is used. */
export type Fetch = (url: string, init?: RequestInit) => Promise<Response>;

/** How addresses are fetched. */
export interface Network {
  fetch: Fetch;
  /** How often a request is repeated that the server or the connection failed. */
  retries: number;
  /** After this number of milliseconds without a byte, a request is given up. */
  timeout: number;
}

/** What is asked for. */
export interface Asked {
  headers?: Record<string, string>;
  /** As in the browser's `RequestInit`, which has it; Node's types have not. */
  cache?: "no-cache";
  /** The body is read only if the answer has this status. */
  status: number;
  /** The most bytes that the body may have. */
  most: number;
}

export interface Answer {
  response: Response;
  body: Uint8Array;
}

/** Milliseconds before the first repetition. They double each time. */
const FIRST_PAUSE = 250;
/** A server that asks for a longer pause is not waited for. */
const LONGEST_PAUSE = 60_000;
const TOO_MANY_REQUESTS = 429;

/** A request that may be repeated. */
class Failure extends Error {
  /** The milliseconds that the server asks to wait. */
  readonly pause: number;

  constructor(why: string, pause: number, cause?: unknown) {
    super(why, { cause });
    this.pause = pause;
  }
}

/**
 * Fetches an address. Repeats the request if the server is busy or fails (429, 5xx), or the connection breaks.
 *
 * @throws HprError `load`; an `AbortError` by the signal.
 */
export async function request(network: Network, url: string, asked: Asked, signal?: AbortSignal): Promise<Answer> {
  for (let tries = 1; ; tries++) {
    try {
      return await attempt(network, url, asked, signal);
    } catch (error) {
      if (!(error instanceof Failure)) {
        throw error;
      }
      if (tries > network.retries || error.pause > LONGEST_PAUSE) {
        throw new HprError("load", `${url} could not be fetched: ${sentenceOf(error, tries)}`, { cause: error.cause });
      }
      const backoff = FIRST_PAUSE * 2 ** (tries - 1) * (1 + Math.random() / 2);
      await pause(Math.max(error.pause, Math.min(backoff, LONGEST_PAUSE)), signal);
    }
  }
}

function sentenceOf({ message, pause }: Failure, tries: number): string {
  const asks = pause > LONGEST_PAUSE ? `, and asks to wait ${Math.ceil(pause / 1000)} s` : "";
  return `${message}${asks} (${tries === 1 ? "1 try" : `${tries} tries`}; see the option retries)`;
}

async function attempt(network: Network, url: string, asked: Asked, signal?: AbortSignal): Promise<Answer> {
  const { status, most, ...init } = asked;
  const timer = new StallTimer(network.timeout, signal);
  try {
    const response = await timer.until(network.fetch(url, { ...init, signal: timer.signal }));
    if (response.status === TOO_MANY_REQUESTS || response.status >= 500) {
      drop(response.body);
      throw new Failure(`the server answered ${response.status}`, pauseOf(response.headers));
    }
    if (response.status === status) {
      return { response, body: await bodyOf(response, url, most, timer) };
    }
    drop(response.body);
    return { response, body: new Uint8Array(0) };
  } catch (error) {
    if (signal?.aborted) {
      throw abortError(BY_SIGNAL);
    }
    if (timer.isLate) {
      const why = `no byte came for ${network.timeout} ms (see the option timeout)`;
      throw new HprError("load", `${url} could not be fetched: ${why}`);
    }
    throw error instanceof HprError || error instanceof Failure ? error : new Failure(asError(error).message, 0, error);
  } finally {
    timer.end();
  }
}

async function bodyOf(response: Response, url: string, most: number, timer: StallTimer): Promise<Uint8Array> {
  const chunks: Uint8Array[] = [];
  let length = 0;
  const reader = response.body?.getReader();
  while (reader !== undefined) {
    const { done, value } = await timer.until(reader.read());
    if (done) {
      break;
    }
    length += value.length;
    if (length > most) {
      drop(reader);
      throw new HprError("load", `${url} could not be read: its server sends more than the ${most} bytes asked for`);
    }
    chunks.push(value);
    timer.begin();
  }
  const body = new Uint8Array(length);
  let at = 0;
  for (const chunk of chunks) {
    body.set(chunk, at);
    at += chunk.length;
  }
  return body;
}

function drop(body: { cancel: () => Promise<void> } | null): void {
  body?.cancel().catch(() => undefined);
}

/** The milliseconds of `Retry-After`: seconds, or a date. */
function pauseOf(headers: Headers): number {
  const after = headers.get("retry-after") ?? "";
  const pause = /^\d+$/.test(after) ? 1000 * Number(after) : Date.parse(after) - Date.now();
  return Math.max(pause, 0) || 0;
}

async function pause(milliseconds: number, signal: AbortSignal | undefined): Promise<void> {
  let timer: ReturnType<typeof setTimeout> | undefined;
  try {
    await untilAborted(signal, new Promise<void>((over) => (timer = setTimeout(over, milliseconds))));
  } finally {
    clearTimeout(timer);
  }
}

/** The silence is counted in so many parts: while this thread computes, only one of them passes. */
const PARTS = 4;

/** Ends a request when its signal aborts, or when no byte comes. */
class StallTimer {
  isLate = false;
  readonly #end = new AbortController();
  readonly #timeout: number;
  readonly #forget: (() => void) | undefined;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(timeout: number, signal: AbortSignal | undefined) {
    this.#timeout = timeout;
    this.#forget =
      signal &&
      whenAborted(signal, () => {
        this.#end.abort();
      });
    this.begin();
  }

  get signal(): AbortSignal {
    return this.#end.signal;
  }

  /** Begins to count anew. */
  begin(part = 1): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      if (part < PARTS) {
        this.begin(part + 1);
      } else {
        this.isLate = true;
        this.#end.abort();
      }
    }, this.#timeout / PARTS);
  }

  until<T>(promise: Promise<T>): Promise<T> {
    return untilAborted(this.#end.signal, promise);
  }

  end(): void {
    clearTimeout(this.#timer);
    this.#forget?.();
    this.#end.abort();
  }
}
