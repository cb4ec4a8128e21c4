import { asError, describe, HprError, typeTag } from "../base/errors.js";
import { hasNodeModules, importNodeModule } from "../base/node.js";
import { reasonOf } from "../worker/abort.js";
import { FormatProblem } from "../formats/problem.js";
import type { Reading } from "../formats/cloud-file.js";
import { blobSource, bytesSource, type Source, wholeFile } from "../formats/source.js";

/** A file, or where it is: an address, or a path in Node. */
export type FileSource = Blob | ArrayBuffer | Uint8Array<ArrayBuffer> | URL | string;

/** A file, its name, and how other files of its folder are read. */
export interface NamedSource {
  source: Source;
  name: string;
  beside?: NonNullable<Reading["beside"]>;
  close: () => Promise<void>;
}

/** The error for a file that cannot be read. */
export function refusal(name: string, cause: unknown): HprError {
  if (cause instanceof HprError) return cause;
  if (!(cause instanceof FormatProblem)) {
    return new HprError("load", `${name} cannot be read: it is broken (${asError(cause).message})`, { cause });
  }
  const wayOut =
    cause.rest === undefined
      ? ""
      : ` ({ damaged: true } reads ${cause.rest === "anyway" ? "what is there" : "the others"})`;
  return new HprError("load", `${name} cannot be read: ${cause.message}${wayOut}`, { cause });
}

const nothing = () => Promise.resolve();

/** Finds the bytes that are meant. A string is a path in Node, and an address in browsers. */
export async function sourceOf(given: unknown, signal: AbortSignal | undefined): Promise<NamedSource> {
  const tag = typeTag(given);
  if (tag === "Blob" || tag === "File") {
    return { source: blobSource(given as Blob), name: (given as Partial<File>).name ?? "the file", close: nothing };
  }
  // Node's Buffer is a Uint8Array.
  if (tag === "ArrayBuffer" || tag === "Uint8Array") {
    const bytes = tag === "Uint8Array" ? (given as Uint8Array<ArrayBuffer>) : new Uint8Array(given as ArrayBuffer);
    return { source: bytesSource(bytes), name: "the file", close: nothing };
  }
  if (given instanceof URL) {
    return given.protocol === "file:" ? openFile(given) : fetched(given, signal);
  }
  if (typeof given !== "string") {
    throw new HprError(
      "option",
      `the source must be a Blob, an ArrayBuffer, a Uint8Array, a URL or a string, got ${describe(given)}`,
    );
  }
  const isAddress = /^(https?|data|blob):/i.test(given);
  if (hasNodeModules() && !isAddress) {
    return openFile(given);
  }
  const page = (globalThis as { location?: { href: string } }).location?.href;
  if (!URL.canParse(given, page)) {
    throw new HprError("option", `the source must be the address of a file, got ${describe(given)}`);
  }
  return fetched(new URL(given, page), signal);
}

async function openFile(path: string | URL): Promise<NamedSource> {
  const name = String(path);
  try {
    const { open } = await importNodeModule<typeof import("node:fs/promises")>("node:fs/promises");
    const { pathToFileURL } = await importNodeModule<typeof import("node:url")>("node:url");
    const handle = await open(path);
    const { size } = await handle.stat();
    const read: Source["read"] = async (from, to) => {
      const bytes = new Uint8Array(Math.max(0, Math.min(to, size) - from));
      let at = 0;
      while (at < bytes.length) {
        const { bytesRead } = await handle.read(bytes, at, bytes.length - at, from + at);
        if (bytesRead === 0) break;
        at += bytesRead;
      }
      return bytes.subarray(0, at);
    };
    const folder = new URL(".", typeof path === "string" ? pathToFileURL(path) : path);
    const beside = async (other: string) => {
      const { source, close } = await openFile(addressOf(other, folder));
      try {
        return await wholeFile(source);
      } finally {
        await close();
      }
    };
    return { source: { size, read }, name, beside, close: () => handle.close() };
  } catch (cause) {
    throw new HprError("load", `${name} cannot be read: ${asError(cause).message}`, { cause });
  }
}

function addressOf(name: string, folder: URL): URL {
  return new URL(name.split("/").map(encodeURIComponent).join("/"), folder);
}

async function fetched(url: URL, signal: AbortSignal | undefined): Promise<NamedSource> {
  const name = url.href.length > 100 ? `${url.href.slice(0, 100)}…` : url.href;
  let response: Response;
  let blob: Blob;
  try {
    response = await fetch(url, signal ? { signal } : {});
    if (response.ok) {
      blob = await response.blob();
      const beside = async (other: string) => {
        const { source } = await fetched(addressOf(other, url), signal);
        return wholeFile(source);
      };
      return { source: blobSource(blob), name, ...(/^https?:$/.test(url.protocol) && { beside }), close: nothing };
    }
  } catch (cause) {
    if (signal?.aborted) throw reasonOf(signal);
    throw new HprError("load", `${name} could not be fetched: ${asError(cause).message}`, { cause });
  }
  throw new HprError("load", `${name} could not be fetched: the server answered ${response.status}`);
}
