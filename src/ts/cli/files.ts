import { constants, rmSync, write } from "node:fs";
import { type FileHandle, lstat, open, readlink, rename, rm, stat } from "node:fs/promises";
import { dirname, resolve } from "node:path";
import { promisify } from "node:util";

import { FormatProblem } from "../formats/problem.js";
import { allocating } from "../formats/builder.js";
import { bytesSource, unpacked } from "../formats/source.js";

const CHUNK = 1 << 24;

/** The number that every program has for its standard output. */
export const STANDARD_OUTPUT = 1;

/** The name of a file that this program has open already. /dev/stdout is a link to such a name. */
const OPEN_FILE = /^\/(?:dev|proc\/self)\/fd\/(\d+)$/;

/** A file that breaks the rules of its format. */
export class InputProblem extends Error {}

/** A file that cannot be written. */
export class OutputProblem extends Error {}

/** Reads a whole file. `onProgress` gets the share that has been read. */
async function readWhole(name: string, onProgress: (share: number) => void): Promise<Buffer<ArrayBuffer>> {
  // Without this flag, opening a FIFO would wait until another program writes to it.
  const handle = await open(name, constants.O_RDONLY | nonBlocking());
  try {
    const stats = await handle.stat();
    if (!stats.isFile()) throw new FormatProblem("it is not a regular file");
    const { size } = stats;
    const file = allocating(size, () => Buffer.allocUnsafe(size));
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

/** Reads a whole file and understands it. Problems are told with its name. */
export async function readAs<T>(
  name: string,
  onProgress: (share: number) => void,
  understand: (file: Buffer<ArrayBuffer>) => T | Promise<T>,
): Promise<T> {
  try {
    const { source } = await unpacked({ source: bytesSource(await readWhole(name, onProgress)), name });
    const { buffer, byteOffset, length } = await source.read(0, source.size);
    return await understand(Buffer.from(buffer, byteOffset, length));
  } catch (cause) {
    // By its name: a loader of modules may hold the class twice, since the larger readers are imported when they are needed.
    if (!(cause instanceof Error && cause.name === "FormatProblem")) throw cause;
    const wayOut =
      (cause as FormatProblem).rest === undefined
        ? ""
        : ` (--damaged reads ${(cause as FormatProblem).rest === "anyway" ? "what is there" : "the others"})`;
    throw new InputProblem(`${name} cannot be read: ${cause.message}${wayOut}`, { cause });
  }
}

/** The flag for opening without waiting. It is 0 on Windows, which has no such flag. */
function nonBlocking(): number {
  return (constants as Partial<typeof constants>).O_NONBLOCK ?? 0;
}

/**
 * Writes a file; "-" is standard output. A FIFO or a device is written to directly. A regular file
 * is first written under another name in the same folder, so that a failure leaves no half of a
 * file. Links are followed, and the permissions of a replaced file stay.
 */
export async function writeWhole(name: string, parts: Iterable<Uint8Array>): Promise<void> {
  if (name === "-") {
    await print(parts);
    return;
  }
  try {
    await writeNamed(name, parts);
  } catch (error) {
    throw new OutputProblem(`${name} cannot be written: ${reason(error)}`, { cause: error });
  }
}

/** The message of an error without the name of the unfinished file, which the user has never seen. */
function reason(error: unknown): string {
  const { message } = error as Error;
  return /^\w+: ([^,]*),/.exec(message)?.[1] ?? message;
}

async function writeNamed(name: string, parts: Iterable<Uint8Array>): Promise<void> {
  const place = await linkedFrom(name);
  if (typeof place === "number") {
    await (place === STANDARD_OUTPUT ? print(parts) : writeOpen(place, parts));
    return;
  }
  const present = await stat(place).catch(() => undefined);
  if (present === undefined || present.isFile()) {
    await replace(place, parts, present === undefined ? undefined : present.mode & 0o777);
  } else if (present.isDirectory()) {
    throw new Error("it is a directory");
  } else if (present.isBlockDevice()) {
    throw new Error("it is a disk");
  } else {
    await writeInto(place, parts, present.isFIFO());
  }
}

/**
 * Follows all links, and returns the place of the file, or the number of an open file. The file may
 * not exist yet.
 */
export async function linkedFrom(name: string): Promise<string | number> {
  let place = name;
  for (let links = 0; links < 40; links++) {
    const open = OPEN_FILE.exec(place);
    if (open !== null) return Number(open[1]);
    const stats = await lstat(place).catch(() => undefined);
    if (stats?.isSymbolicLink() !== true) return place;
    // A link of another process stands for its open file, which may have no name.
    if ((await stat(place).catch(() => undefined))?.isFile() === false) return place;
    place = resolve(dirname(place), await readlink(place));
  }
  throw new Error("its links lead to one another");
}

async function writeInto(place: string, parts: Iterable<Uint8Array>, isFifo: boolean): Promise<void> {
  // This fails at once if no program reads the FIFO. The `open` below would wait, perhaps for ever.
  const probe = isFifo ? await open(place, constants.O_WRONLY | nonBlocking()).catch(noReader) : undefined;
  try {
    const handle = await open(place, constants.O_WRONLY);
    await writeAll(handle, parts);
  } finally {
    await probe?.close();
  }
}

function noReader(error: NodeJS.ErrnoException): never {
  throw error.code === "ENXIO" ? new Error("it is a FIFO that no program reads") : error;
}

async function replace(place: string, parts: Iterable<Uint8Array>, mode: number | undefined): Promise<void> {
  const unfinished = `${place}.${process.pid}.part`;
  const stopListening = onSignals(() => {
    rmSync(unfinished, { force: true });
  });
  try {
    const handle = await open(unfinished, "wx", mode);
    try {
      await writeAll(handle, parts);
      await rename(unfinished, place);
    } catch (error) {
      await rm(unfinished, { force: true });
      throw error;
    }
  } finally {
    stopListening();
  }
}

/**
 * Cleans up when a signal ends the process, and then lets the signal end it as usual. Returns a
 * function that stops the listening.
 */
function onSignals(cleanUp: () => void): () => void {
  const signals = ["SIGINT", "SIGTERM", "SIGHUP"] as const;
  const end = (signal: NodeJS.Signals) => {
    stop();
    cleanUp();
    process.kill(process.pid, signal);
  };
  const stop = () => {
    for (const signal of signals) process.off(signal, end);
  };
  for (const signal of signals) process.on(signal, end);
  return stop;
}

async function print(parts: Iterable<Uint8Array>): Promise<void> {
  // An error also comes as an event, which ends the process if nobody listens to it.
  process.stdout.on("error", () => undefined);
  for (const chunk of gathered(parts)) {
    await new Promise<void>((done, fail) => {
      process.stdout.write(chunk, (error) => {
        if (error) fail(error);
        else done();
      });
    });
  }
}

/** Writes where the open file stands. Opening its name again would begin at its start. */
async function writeOpen(file: number, parts: Iterable<Uint8Array>): Promise<void> {
  for (const chunk of gathered(parts)) {
    for (let at = 0; at < chunk.length;) at += (await promisify(write)(file, chunk, at)).bytesWritten;
  }
}

/** Also closes the file. */
async function writeAll(handle: FileHandle, parts: Iterable<Uint8Array>): Promise<void> {
  try {
    for (const chunk of gathered(parts)) await handle.writeFile(chunk);
  } finally {
    await handle.close();
  }
}

/** Joins small pieces into few large ones. */
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
