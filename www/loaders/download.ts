import wasm from "../../src/ts/formats/files.wasm?url";
import { LoadProblem, type LoadRequest, missingPart } from "./protocol.ts";
import type { PreparedCloud } from "../cloud/cloud.ts";
import { prepareCloud } from "../cloud/prepare.ts";

/**
 * The browser keeps the pieces of a download, large ones on disk. There is a limit, because a download may never end.
 */
const MAX_DOWNLOAD = 4_000_000_000;

/** Downloads a whole file. Reports the progress if the server gives the length. */
export async function download(
  name: string,
  url: string,
  onProgress: (fraction: number | null) => void,
): Promise<Blob> {
  return receive(name, await ask(name, url), onProgress);
}

/** Downloads a whole file that is small. */
export async function downloadBytes(name: string, url: string): Promise<Uint8Array> {
  return bodyOf(name, await ask(name, url));
}

async function ask(name: string, url: string): Promise<Response> {
  let response: Response;
  try {
    response = await fetch(url);
  } catch {
    const own = new URL(url, location.href).origin === location.origin;
    const why = own ? "the connection failed" : "the address does not answer, or does not allow other pages to read it";
    throw new LoadProblem(`${name} could not be downloaded: ${why}.`);
  }
  if (!response.ok) throw new LoadProblem(`${name} could not be downloaded: the server answered ${response.status}.`);
  return response;
}

async function bodyOf(name: string, response: Response): Promise<Uint8Array> {
  try {
    return new Uint8Array(await response.arrayBuffer());
  } catch {
    throw brokeOff(name);
  }
}

async function receive(name: string, response: Response, onProgress: (fraction: number | null) => void): Promise<Blob> {
  // With compression, the given length is that of the compressed data. Then the fraction is unknown.
  const compressed = response.headers.get("content-encoding") !== null;
  const total = compressed ? 0 : Number(response.headers.get("content-length") ?? 0);
  checkSize(name, total);
  onProgress(total > 0 ? 0 : null);

  const chunks: Uint8Array<ArrayBuffer>[] = [];
  let received = 0;
  const reader = response.body!.getReader();
  try {
    for (let part = await reader.read(); !part.done; part = await reader.read()) {
      chunks.push(part.value);
      received += part.value.length;
      checkSize(name, received);
      onProgress(total > 0 ? Math.min(1, received / total) : null);
    }
  } catch (error) {
    void reader.cancel().catch(() => undefined);
    throw error instanceof LoadProblem ? error : brokeOff(name);
  }
  return new Blob(chunks);
}

function brokeOff(name: string): LoadProblem {
  return new LoadProblem(`${name} could not be downloaded: the connection broke off.`);
}

function checkSize(name: string, bytes: number): void {
  if (bytes > MAX_DOWNLOAD) {
    throw new LoadProblem(`${name} is too large to be downloaded: more than ${MAX_DOWNLOAD / 1e9} GB.`);
  }
}

/** Loads the file of a sample in the page's thread: there is nothing to read, and a worker would start later than it comes. */
export async function loadSample({ name, url }: LoadRequest & { kind: "sample" }): Promise<PreparedCloud> {
  const { buffer: data } = await downloadBytes(name, url);
  // Some servers answer with a page if they do not have the file.
  if (data.byteLength % 12 !== 0) {
    throw new LoadProblem(`${name} could not be downloaded: the server sent something else.`);
  }
  return prepareCloud({ positions: new Float32Array(data), colors: null });
}

/** The page itself serves the wasm that reads LAZ and E57. */
export async function compileFiles(name: string): Promise<WebAssembly.Module> {
  try {
    return await WebAssembly.compile(await (await fetch(wasm)).arrayBuffer());
  } catch {
    throw missingPart(name);
  }
}
