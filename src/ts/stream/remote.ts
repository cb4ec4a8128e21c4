import { asError, HprError } from "../base/errors.js";
import { reasonOf, untilAborted, whenAborted } from "../worker/abort.js";

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
      throw reasonOf(signal);
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

/** `metadata.json` has some kB. */
const LARGEST_WHOLE = 2 ** 24;

/** What the headers of an answer tell about the version of its file. Each is undefined if it cannot be read. */
interface Version {
  etag: string | undefined;
  modified: string | undefined;
  /** The number of bytes of the whole file. */
  total: number | undefined;
}

/** Files that belong together. When one of them has changed, none is read any further. */
export interface Together {
  changed?: HprError;
}

/**
 * A file on a server. The first answer pins its version. An answer of another version is refused, and so is every
 * question after it.
 */
export class RemoteFile {
  readonly #url: string;
  readonly #network: Network;
  readonly #together: Together;
  /** That of the first answer. */
  #version: Version | undefined;
  /** Whether the first answer came from the page's own origin, or there is no page. */
  #isOwn = false;
  #whole: Uint8Array | undefined;

  constructor(url: string, network: Network, together: Together) {
    this.#url = url;
    this.#network = network;
    this.#together = together;
  }

  /** Reads a range of bytes. Fewer come only if the file ends before. */
  async read(from: number, to: number, signal?: AbortSignal): Promise<Uint8Array> {
    this.#requireUnchanged();
    const headers = { Range: `bytes=${from}-${to - 1}`, ...this.#ifRange() };
    const { response, body } = await request(
      this.#network,
      this.#url,
      { headers, status: 206, most: to - from },
      signal,
    );
    this.#requireUnchanged();
    const range = response.headers.get("content-range");
    const total = totalOf(range);
    const pinned = this.#version;
    if (pinned !== undefined && (response.status === 200 || response.status === 412)) {
      throw this.#change(`its server answered ${response.status} to a range request`);
    }
    if (response.status === 416) {
      this.#compare({ etag: undefined, modified: undefined, total });
    }
    if (response.status === 200) {
      throw this.#unreadable("its server does not answer range requests");
    }
    if (response.status !== 206) {
      throw this.#unfetched(response.status);
    }
    this.#pin(response, total);
    this.#checkRange(range, from, to, body.length);
    const encoding = response.headers.get("content-encoding") ?? "identity";
    const type = response.headers.get("content-type") ?? "";
    if (encoding !== "identity" || type.startsWith("multipart/")) {
      throw this.#unreadable(`its server sends ranges as ${encoding === "identity" ? type : encoding}`);
    }
    return body;
  }

  /** Reads the whole file, which must be small. If it was read before, it must be the same. */
  async whole(): Promise<Uint8Array> {
    this.#requireUnchanged();
    // Caches must ask the server: an old copy does not belong to the other files.
    const asked = { status: 200, most: LARGEST_WHOLE, cache: "no-cache" } as const;
    const { response, body } = await request(this.#network, this.#url, asked);
    this.#requireUnchanged();
    if (response.status !== 200) {
      throw this.#unfetched(response.status);
    }
    this.#pin(response, undefined);
    this.#whole ??= body;
    if (body.length !== this.#whole.length || body.some((byte, i) => byte !== this.#whole![i])) {
      throw this.#change("its contents are others");
    }
    return body;
  }

  /**
   * The header that makes a server refuse ranges of another version. Elsewhere it would need a
   * permission (a preflight) that servers of static files do not give.
   */
  #ifRange(): { "If-Range"?: string } {
    const etag = this.#version?.etag;
    return this.#isOwn && etag !== undefined && !isWeak(etag) ? { "If-Range": etag } : {};
  }

  #pin({ headers, url }: Response, total: number | undefined): void {
    const version = {
      etag: headers.get("etag") ?? undefined,
      modified: headers.get("last-modified") ?? undefined,
      total,
    };
    if (this.#version !== undefined) {
      this.#compare(version);
      return;
    }
    this.#version = version;
    const page = (globalThis as { location?: { origin: string } }).location?.origin;
    // A redirect may have led elsewhere.
    this.#isOwn = page === undefined || new URL(url || this.#url).origin === page;
  }

  /** Compares all that both answers tell. The date counts only without strong tags: several servers may differ in it. */
  #compare(now: Version): void {
    const before = this.#version;
    if (before === undefined) {
      return;
    }
    const hasTags = before.etag !== undefined && now.etag !== undefined;
    const isSure = hasTags && !isWeak(before.etag!) && !isWeak(now.etag!);
    if (hasTags && opaque(before.etag!) !== opaque(now.etag!)) {
      throw this.#change(`its ETag was ${before.etag} and is ${now.etag}`);
    }
    if (!isSure && differ(before.modified, now.modified)) {
      throw this.#change(`it was modified ${before.modified}, and now ${now.modified}`);
    }
    if (differ(before.total, now.total)) {
      throw this.#change(`it had ${before.total} bytes and has ${now.total}`);
    }
  }

  /** @param range the header `Content-Range`, which pages of other origins often cannot read. */
  #checkRange(range: string | null, from: number, to: number, length: number): void {
    if (range === null) {
      return;
    }
    const [, first, last] = RANGE.exec(range) ?? [];
    const end = Math.min(to, totalOf(range) ?? Infinity);
    if (Number(first) !== from || Number(last) !== end - 1) {
      throw this.#unreadable(`its server sends "${range}" instead of the bytes ${from} to ${end - 1}`);
    }
    if (length !== end - from) {
      throw this.#unreadable(`${length} of the ${end - from} bytes at byte ${from} came: it may be cut off`);
    }
  }

  #requireUnchanged(): void {
    if (this.#together.changed) {
      throw this.#together.changed;
    }
  }

  #change(why: string): HprError {
    return (this.#together.changed ??= new HprError(
      "load",
      `${this.#url} cannot be read any further: the file has changed (${why}); open it again`,
    ));
  }

  #unreadable(why: string): HprError {
    return new HprError("load", `${this.#url} cannot be read in parts: ${why}`);
  }

  #unfetched(status: number): HprError {
    return new HprError("load", `${this.#url} could not be fetched: the server answered ${status}`);
  }
}

const RANGE = /^bytes (\d+)-(\d+)\/(?:\d+|\*)$/;

function totalOf(range: string | null): number | undefined {
  const total = range === null ? null : /^bytes .*\/(\d+)$/.exec(range);
  return total === null ? undefined : Number(total[1]);
}

/** A weak tag may stay the same when bytes change. */
function isWeak(etag: string): boolean {
  return etag.startsWith("W/");
}

function opaque(etag: string): string {
  return etag.replace(/^W\//, "");
}

function differ<T>(before: T | undefined, now: T | undefined): boolean {
  return before !== undefined && now !== undefined && before !== now;
}
