import { asError, describe, HprError, typeTag } from "../base/errors.js";

/**
 * Reads the bytes of a file from one offset up to another. The result is shorter only if the file
 * ends before. It may reject with any error, also after the signal has aborted.
 */
export type RangeReader = (from: number, to: number, signal?: AbortSignal) => Promise<Uint8Array>;

/** The files of a Potree 2 octree that the caller reads in their own way. */
export interface PotreeFiles {
  /** The contents of `metadata.json`, parsed. */
  metadata: unknown;
  hierarchy: RangeReader;
  octree: RangeReader;
}

/** The part of `fetch` that is used. */
export type Fetch = (url: string, init?: RequestInit) => Promise<Response>;

/** The files of an octree, and how messages name them. */
export type Files = { name: string } & ({ format: "copc"; read: RangeReader } | ({ format: "potree" } & PotreeFiles));

/**
 * Finds out which files are meant. An address that ends in `.json` is that of a Potree 2 octree.
 *
 * @throws HprError `option`, `load`.
 */
export async function filesOf(source: unknown, fetcher: Fetch): Promise<Files> {
  if (typeof source === "string" || source instanceof URL) {
    return filesAt(String(source), fetcher);
  }
  if (typeof source === "function") {
    return { format: "copc", name: "the COPC file", read: source as RangeReader };
  }
  if (typeTag(source) === "Blob" || typeTag(source) === "File") {
    const blob = source as Blob;
    const read: RangeReader = async (from, to) => new Uint8Array(await blob.slice(from, to).arrayBuffer());
    return { format: "copc", name: blob instanceof File ? blob.name : "the COPC file", read };
  }
  const { metadata, hierarchy, octree } = (source ?? {}) as Partial<PotreeFiles>;
  if (metadata !== undefined && typeof hierarchy === "function" && typeof octree === "function") {
    return { format: "potree", name: "the Potree octree", metadata, hierarchy, octree };
  }
  throw new HprError(
    "option",
    `the source must be an address, a Blob, a function that reads ranges, or { metadata, hierarchy, octree }, got ${describe(source)}`,
  );
}

async function filesAt(address: string, fetcher: Fetch): Promise<Files> {
  const base = (globalThis as { location?: { href: string } }).location?.href;
  if (!URL.canParse(address, base)) {
    throw new HprError("option", `the source must be the address of a file, got ${describe(address)}`);
  }
  const url = new URL(address, base);
  if (!url.pathname.endsWith(".json")) {
    return { format: "copc", name: url.href, read: rangesOf(url.href, fetcher) };
  }
  const beside = (name: string) => {
    const other = new URL(name, url);
    // Signed addresses carry their signature in the query.
    other.search = url.search;
    return rangesOf(other.href, fetcher);
  };
  const metadata = await json(url.href, fetcher);
  return {
    format: "potree",
    name: url.href,
    metadata,
    hierarchy: beside("hierarchy.bin"),
    octree: beside("octree.bin"),
  };
}

async function json(url: string, fetcher: Fetch): Promise<unknown> {
  const response = await ask(url, fetcher, {});
  try {
    return (await response.json()) as unknown;
  } catch (cause) {
    throw new HprError("load", `${url} is not a JSON file`, { cause });
  }
}

function rangesOf(url: string, fetcher: Fetch): RangeReader {
  return async (from, to, signal) => {
    const headers = { Range: `bytes=${from}-${to - 1}` };
    const response = await ask(url, fetcher, { headers, ...(signal && { signal }) });
    if (response.status !== 206) {
      await response.body?.cancel();
      throw new HprError("load", `${url} cannot be read in parts: its server does not answer range requests`);
    }
    try {
      return new Uint8Array(await response.arrayBuffer());
    } catch (cause) {
      throw refused(url, cause, signal);
    }
  };
}

async function ask(url: string, fetcher: Fetch, init: RequestInit): Promise<Response> {
  let response: Response;
  try {
    response = await fetcher(url, init);
  } catch (cause) {
    throw refused(url, cause, init.signal ?? undefined);
  }
  if (!response.ok) {
    await response.body?.cancel();
    throw new HprError("load", `${url} could not be fetched: the server answered ${response.status}`);
  }
  return response;
}

function refused(url: string, cause: unknown, signal: AbortSignal | undefined): Error {
  const error = asError(cause);
  return signal?.aborted ? error : new HprError("load", `${url} could not be fetched: ${error.message}`, { cause });
}

/** Reads a range that must be complete. */
export async function readPart(
  name: string,
  read: RangeReader,
  { offset, length }: Part,
  signal?: AbortSignal,
): Promise<Uint8Array> {
  const isPart = Number.isSafeInteger(offset) && Number.isSafeInteger(length) && offset >= 0 && length > 0;
  if (!isPart || length > LARGEST_PART) {
    throw broken(name, `it lists a part of ${length} bytes at byte ${offset}`);
  }
  const bytes = await read(offset, offset + length, signal);
  if (bytes.length !== length) {
    throw broken(name, `${bytes.length} of the ${length} bytes at byte ${offset} came: it may be cut off`);
  }
  return bytes;
}

/** A place in a file. */
export interface Part {
  offset: number;
  length: number;
}

/** Nodes have some 100 kB. */
const LARGEST_PART = 2 ** 28;

/** The error of files that contradict themselves. */
export function broken(name: string, why: string, cause?: unknown): HprError {
  return new HprError("load", `${name} is broken: ${why}`, { cause });
}
