import { LONGEST_LINE, tooLong } from "../../src/ts/formats/text.js";
import { LoadProblem } from "./problem.ts";

/** Where a file is read from, how many points of it at most, and who wants to hear how far it is. */
export interface Reading {
  name: string;
  blob: Blob;
  limit: number;
  /** 0 … 1 */
  onProgress: (fraction: number) => void;
}

export const BLOCK = 1 << 24;

/** A file's bytes from `start`, a piece at a time: of a large file only that piece is in memory. */
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

/** Rows of `rowBytes` each, `count` of them from `start`: calls back with a view and where the row begins in it. */
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

/** The lines of a text, by hundreds of thousands. The first one is counted as `firstNumber`. */
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
    // What stands after the last end of a line is not whole yet; nor is a return that the next block may go on.
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
