import { checkByteLength } from "./limits.ts";
import { LoadProblem } from "./problem.ts";

/** Fetches a file whole, telling how far it is where the server says how long it is. */
export async function download(name: string, url: string, onProgress: (fraction: number | null) => void): Promise<ArrayBuffer> {
  let response: Response;
  try {
    response = await fetch(url);
  } catch {
    const why =
      new URL(url, location.href).origin === location.origin
        ? "the connection failed"
        : "the address does not answer, or does not allow other pages to read it";
    throw new LoadProblem(`${name} could not be downloaded: ${why}.`);
  }
  if (!response.ok) throw new LoadProblem(`${name} could not be downloaded: the server answered ${response.status}.`);

  // With a compressed transfer the length is that of the wire, not of what arrives: no fraction then.
  const compressed = response.headers.get("content-encoding") !== null;
  const total = compressed ? 0 : Number(response.headers.get("content-length") ?? 0);
  if (total > 0) checkByteLength(name, total);
  onProgress(total > 0 ? 0 : null);

  const chunks: Uint8Array<ArrayBuffer>[] = [];
  let received = 0;
  const reader = response.body!.getReader();
  try {
    for (let part = await reader.read(); !part.done; part = await reader.read()) {
      chunks.push(part.value);
      received += part.value.length;
      checkByteLength(name, received);
      onProgress(total > 0 ? Math.min(1, received / total) : null);
    }
  } catch (error) {
    void reader.cancel().catch(() => undefined);
    throw error instanceof LoadProblem ? error : new LoadProblem(`${name} could not be downloaded: the connection broke off.`);
  }
  checkByteLength(name, received);
  return new Blob(chunks).arrayBuffer();
}
