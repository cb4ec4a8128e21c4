// A server of files whose answers are wrong on purpose, as the `fetch` of the stream.

/** The contents of a server: files by the end of their address. */
export type Site = Readonly<Record<string, Uint8Array>>;

/** What a server does to one request. */
export type Fault =
  | { kind: "status"; status: number; retryAfter?: string }
  | { kind: "reset" | "cut" | "endless" | "silent" | "shifted" | "short" | "long" | "multipart" | "gzip" | "whole" }
  | { kind: "slow"; milliseconds: number };

/** Which headers the answers have, as far as a page of another origin can read them. */
export interface Telling {
  etag: "strong" | "weak" | "none";
  modified: boolean;
  contentRange: boolean;
}

export interface Behavior {
  /** The contents before the change, and after it. */
  sites: readonly [Site, Site];
  /** The number of the first request to the second contents. */
  replacedAt: number;
  telling: Telling;
  /** The faults of requests, by their numbers from 0. */
  faults: ReadonlyMap<number, Fault>;
  /** Whether a request with `If-Range` of another version gets the whole file. */
  knowsIfRange: boolean;
}

export interface Server {
  fetch: (url: string, init?: RequestInit) => Promise<Response>;
  /** The number of requests so far. */
  asked: () => number;
}

const wait = (milliseconds: number) => new Promise<void>((resolve) => setTimeout(resolve, milliseconds));

export function serverOf({ sites, replacedAt, telling, faults, knowsIfRange }: Behavior): Server {
  let count = 0;
  const answer = async (url: string, init: RequestInit): Promise<Response> => {
    const number = count++;
    const version = number >= replacedAt ? 1 : 0;
    const fault = faults.get(number);
    const file = sites[version][new URL(url).pathname.split("/").at(-1)!];
    if (fault?.kind === "slow") await wait(fault.milliseconds);
    if (fault?.kind === "reset") throw new TypeError("fetch failed");
    if (fault?.kind === "silent") return new Promise<never>(() => undefined);
    const status = (code: number, after?: string) =>
      new Response("no", { status: code, headers: after === undefined ? {} : { "retry-after": after } });
    if (fault?.kind === "status") return status(fault.status, fault.retryAfter);
    if (file === undefined) return status(404);

    const headers = headersOf(version, telling);
    const asked = new Headers(init.headers);
    const range = /^bytes=(\d+)-(\d+)$/.exec(asked.get("range") ?? "");
    const condition = asked.get("if-range");
    const isOther = knowsIfRange && condition !== null && condition !== headers.get("etag");
    if (!range || isOther || fault?.kind === "whole") return bodyFor(file, 200, headers, fault);
    const [first, last] = [Number(range[1]), Number(range[2])];
    const from = first + (fault?.kind === "shifted" ? 1 : 0);
    const end = Math.min(last + 1, file.length);
    if (from >= end) {
      headers.set("content-range", `bytes */${file.length}`);
      return new Response("no", { status: 416, headers: telling.contentRange ? headers : {} });
    }
    if (telling.contentRange) headers.set("content-range", `bytes ${from}-${end - 1}/${file.length}`);
    return bodyFor(file.subarray(from, end), 206, headers, fault);
  };
  return { fetch: (url, init = {}) => answer(url, init), asked: () => count };
}

function headersOf(version: number, { etag, modified }: Telling): Headers {
  const headers = new Headers({ "content-type": "application/octet-stream" });
  if (etag !== "none") headers.set("etag", `${etag === "weak" ? "W/" : ""}"version-${version}"`);
  if (modified) headers.set("last-modified", new Date(Date.UTC(2026, 0, 1 + version)).toUTCString());
  return headers;
}

function bodyFor(bytes: Uint8Array, status: number, headers: Headers, fault: Fault | undefined): Response {
  const { kind } = fault ?? {};
  if (kind === "multipart") headers.set("content-type", "multipart/byteranges; boundary=x");
  if (kind === "gzip") headers.set("content-encoding", "gzip");
  if (kind === "short") return new Response(bytes.slice(0, -1), { status, headers });
  if (kind === "long") return new Response(Uint8Array.from([...bytes, 7]), { status, headers });
  if (kind !== "cut" && kind !== "endless") return new Response(bytes.slice(), { status, headers });
  let sent = 0;
  const stream = new ReadableStream<Uint8Array>({
    pull(controller) {
      sent += 1;
      if (sent === 1) controller.enqueue(bytes.slice(0, bytes.length >> 1));
      else if (kind === "cut") controller.error(new TypeError("terminated"));
      else controller.enqueue(new Uint8Array(2 ** 18));
    },
  });
  return new Response(stream, { status, headers });
}
