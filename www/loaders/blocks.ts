import { LONGEST_LINE, tooLong } from "../../src/ts/formats/text.js";
import { LoadProblem } from "./problem.ts";

/** The file to read, the largest number of points to keep, and the listener for the progress. */
export interface Reading {
  name: string;
  blob: Blob;
  limit: number;
  /** An octree with more points than this is streamed. */
  streamFrom?: number | undefined;
  /** The progress from 0 to 1. */
  onProgress: (fraction: number) => void;
  /** Takes points that have been read, measured from the first one. */
  onPoints?: (points: Float32Array, first: [number, number, number]) => void;
}

export const BLOCK = 1 << 24;

/** A file's bytes from `start`, one piece at a time: only that piece of a large file is in memory. */
export async function* blocks(
  { name, blob, onProgress }: Reading,
  start: number,
  multipleOf = 1,
): AsyncGenerator<ArrayBuffer> {
  const length = Math.max(1, Math.floor(BLOCK / multipleOf)) * multipleOf;
  for (let at = start; at < blob.size; at += length) {
    onProgress(at / blob.size);
    yield await bytes(name, blob, at, at + length);
  }
}

export async function bytes(name: string, blob: Blob, from: number, to: number): Promise<ArrayBuffer> {
  try {
    return await blob.slice(from, to).arrayBuffer();
  } catch {
    throw new LoadProblem(`${name} could not be read: it was moved or changed, or there is too little memory.`);
  }
}

/**
 * Reads `count` rows of `rowBytes` bytes each, from `start` on. Calls back with a view and the place of the row in it.
 */
export async function eachRow(
  reading: Reading,
  { start, rowBytes, count }: { start: number; rowBytes: number; count: number },
  onRow: (view: DataView, at: number) => void,
): Promise<void> {
  let left = count;
  for await (const block of blocks(reading, start, rowBytes)) {
    const view = new DataView(block);
    const rows = Math.min(left, Math.floor(block.byteLength / rowBytes));
    for (let row = 0; row < rows; row++) onRow(view, row * rowBytes);
    left -= rows;
    if (left === 0) break;
  }
}

/** The lines of a text, in groups of hundreds of thousands. `firstNumber` is the number of the first line. */
export async function* lines(
  reading: Reading,
  start: number,
  { encoding = "utf-8", firstNumber = 1 } = {},
): AsyncGenerator<string[]> {
  const decoder = new TextDecoder(encoding);
  let rest = "";
  let number = firstNumber;
  for await (const block of blocks(reading, start)) {
    const text = rest + decoder.decode(block, { stream: true });
    // The text after the last line end is not complete yet. A carriage return may belong to a line end that the next
    // block completes.
    const end = Math.max(text.lastIndexOf("\n"), text.lastIndexOf("\r", text.length - 2)) + 1;
    rest = text.slice(end);
    if (rest.length > LONGEST_LINE) throw tooLong(end > 0 ? number + split(text.slice(0, end)).length - 1 : number);
    if (end === 0) continue;
    const some = split(text.slice(0, end)).slice(0, -1);
    checkLengths(some, number);
    yield some;
    number += some.length;
  }
  const last = rest + decoder.decode();
  if (last === "") return;
  const some = split(last);
  checkLengths(some, number);
  yield some;
}

function checkLengths(some: readonly string[], first: number): void {
  const long = some.findIndex((line) => line.length > LONGEST_LINE);
  if (long >= 0) throw tooLong(first + long);
}

function split(text: string): string[] {
  return text.includes("\r") ? text.split(/\r\n|\r|\n/) : text.split("\n");
}
