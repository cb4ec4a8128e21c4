import { asError, describe, HprError, typeTag } from "../base/errors.js";
import { untilAborted } from "../worker/abort.js";
import { RemoteFile, type Together } from "./remote.js";
import type { Network } from "./remote.js";

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

/** The files of an octree, and how messages name them. */
export type Files = { name: string } & ({ format: "copc"; read: RangeReader } | ({ format: "potree" } & PotreeFiles));

/**
 * Finds out which files are meant. An address that ends in `.json` is that of a Potree 2 octree.
 *
 * @throws HprError `option`, `load`.
 */
export async function filesOf(source: unknown, network: Network): Promise<Files> {
  if (typeof source === "string" || source instanceof URL) {
    return filesAt(String(source), network);
  }
  if (typeof source === "function") {
    return { format: "copc", name: "the COPC file", read: source as RangeReader };
  }
  if (typeTag(source) === "Blob" || typeTag(source) === "File") {
    const blob = source as Blob;
    const name = blob instanceof File ? blob.name : "the COPC file";
    return { format: "copc", name, read: (from, to) => slice(name, blob, from, to) };
  }
  const { metadata, hierarchy, octree } = (source ?? {}) as Partial<PotreeFiles>;
  const { attributes } = (metadata ?? {}) as { attributes?: unknown };
  if (
    Array.isArray(attributes) &&
    attributes.some((attribute) => typeof attribute !== "object" || attribute === null)
  ) {
    throw new HprError("option", "the attributes of the metadata must be objects");
  }
  if (metadata !== undefined && typeof hierarchy === "function" && typeof octree === "function") {
    return { format: "potree", name: "the Potree octree", metadata, hierarchy, octree };
  }
  throw new HprError(
    "option",
    `the source must be an address, a Blob, a function that reads ranges, or { metadata, hierarchy, octree }, got ${describe(source)}`,
  );
}

/** The system refuses to read a file that has changed on the device. */
async function slice(name: string, blob: Blob, from: number, to: number): Promise<Uint8Array> {
  try {
    return new Uint8Array(await blob.slice(from, to).arrayBuffer());
  } catch (cause) {
    const why = `the file has changed, or it cannot be read (${asError(cause).message})`;
    throw new HprError("load", `${name} cannot be read any further: ${why}; open it again`, { cause });
  }
}

async function filesAt(address: string, network: Network): Promise<Files> {
  const base = (globalThis as { location?: { href: string } }).location?.href;
  if (!URL.canParse(address, base)) {
    throw new HprError("option", `the source must be the address of a file, got ${describe(address)}`);
  }
  const url = new URL(address, base);
  const together: Together = {};
  const file = new RemoteFile(url.href, network, together);
  if (!url.pathname.endsWith(".json")) {
    return { format: "copc", name: url.href, read: (...range) => file.read(...range) };
  }
  const beside = (name: string): RangeReader => {
    const other = new URL(name, url);
    // Signed addresses carry their signature in the query.
    other.search = url.search;
    const part = new RemoteFile(other.href, network, together);
    // Its first answer belongs to the metadata, if these are still the same afterwards.
    let isSame: Promise<unknown> | undefined;
    return async (from, to, signal) => {
      const bytes = await part.read(from, to, signal);
      isSame ??= file.whole().catch((error: unknown) => {
        isSame = undefined;
        throw error;
      });
      await untilAborted(signal, isSame);
      return bytes;
    };
  };
  const metadata = parsed(url.href, await file.whole());
  return {
    format: "potree",
    name: url.href,
    metadata,
    hierarchy: beside("hierarchy.bin"),
    octree: beside("octree.bin"),
  };
}

function parsed(url: string, bytes: Uint8Array): unknown {
  try {
    return JSON.parse(new TextDecoder().decode(bytes)) as unknown;
  } catch (cause) {
    throw new HprError("load", `${url} is not a JSON file`, { cause });
  }
}

/** Reads a range that must be complete. */
export async function readRange(
  name: string,
  read: RangeReader,
  { offset, length }: ByteRange,
  signal?: AbortSignal,
): Promise<Uint8Array> {
  const isRange = Number.isSafeInteger(offset) && Number.isSafeInteger(length) && offset >= 0 && length > 0;
  if (!isRange || length > LARGEST_RANGE) {
    throw broken(name, `it lists a part of ${length} bytes at byte ${offset}`);
  }
  const bytes = await read(offset, offset + length, signal);
  if (bytes.length !== length) {
    throw broken(name, `${bytes.length} of the ${length} bytes at byte ${offset} came: it may be cut off`);
  }
  return bytes;
}

/** A place in a file. */
export interface ByteRange {
  offset: number;
  length: number;
}

/** Nodes have some 100 kB. */
const LARGEST_RANGE = 2 ** 28;

/** The error of files that contradict themselves. */
export function broken(name: string, why: string, cause?: unknown): HprError {
  return new HprError("load", `${name} is broken: ${why}`, { cause });
}
