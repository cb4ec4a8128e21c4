import { type FileHandle, open, realpath, rename, rm, stat } from "node:fs/promises";

import { FileProblem } from "./formats/point-file.js";

const CHUNK = 1 << 24;

/** A whole file; `onProgress` hears what share of it has been read. */
export async function readWhole(name: string, onProgress: (share: number) => void): Promise<Buffer> {
  const handle = await open(name);
  try {
    const stats = await handle.stat();
    if (!stats.isFile()) throw new FileProblem("it is not a regular file");
    const { size } = stats;
    const file = room(size);
    let at = 0;
    while (at < size) {
      const { bytesRead } = await handle.read(file, at, Math.min(CHUNK, size - at));
      if (bytesRead === 0) break;
      at += bytesRead;
      onProgress(at / size);
    }
    return file.subarray(0, at);
  } finally {
    await handle.close();
  }
}

function room(size: number): Buffer {
  try {
    return Buffer.allocUnsafe(size);
  } catch (cause) {
    throw new FileProblem(`no memory for its ${size} bytes`, { cause });
  }
}

/**
 * Writes a file beside its place first, so that a failure leaves no half of it; "-" is
 * standard output. What it replaces is what a link leads to, and who may read it stays.
 */
export async function writeWhole(name: string, parts: Iterable<Uint8Array>): Promise<void> {
  if (name === "-") {
    // It comes a second time as an event, which ends the process if nobody listens.
    process.stdout.on("error", () => undefined);
    for (const chunk of gathered(parts)) await print(chunk);
    return;
  }
  const place = await realpath(name).catch(() => name);
  const mode = await stat(place).then(
    (stats) => stats.mode & 0o777,
    () => undefined,
  );
  const unfinished = `${place}.${process.pid}.part`;
  const handle = await open(unfinished, "w", mode);
  try {
    await writeAll(handle, parts).finally(() => handle.close());
    await rename(unfinished, place);
  } catch (error) {
    await rm(unfinished, { force: true });
    throw error;
  }
}

function print(chunk: Uint8Array): Promise<void> {
  return new Promise((resolve, reject) => {
    process.stdout.write(chunk, (error) => {
      if (error) reject(error);
      else resolve();
    });
  });
}

async function writeAll(handle: FileHandle, parts: Iterable<Uint8Array>): Promise<void> {
  for (const chunk of gathered(parts)) await handle.writeFile(chunk);
}

/** Few large pieces instead of many small ones. */
function* gathered(parts: Iterable<Uint8Array>): Generator<Buffer> {
  let waiting: Uint8Array[] = [];
  let bytes = 0;
  for (const part of parts) {
    waiting.push(part);
    bytes += part.length;
    if (bytes < CHUNK) continue;
    yield Buffer.concat(waiting);
    [waiting, bytes] = [[], 0];
  }
  if (bytes > 0) yield Buffer.concat(waiting);
}
