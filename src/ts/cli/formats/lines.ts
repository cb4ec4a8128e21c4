import { type Line, LONGEST_LINE, markLength, tooLong } from "../../formats/text.js";
import { Numbers } from "./numbers.js";
import type { Records } from "./point-file.js";

const [LINE_FEED, RETURN] = [0x0a, 0x0d];

/** The lines of a file from a place on. They may have any kind of line end. */
export function* linesOf(file: Buffer, from = 0, firstNumber = 1): Generator<Line> {
  let start = from;
  let [feed, back] = [-1, -1];
  for (let number = firstNumber; start < file.length; number++) {
    if (feed < start) feed = place(file, LINE_FEED, start);
    if (back < start) back = place(file, RETURN, start);
    const last = Math.min(feed, back);
    const end = Math.min(last + (feed === back + 1 ? 2 : 1), file.length);
    if (end - start > LONGEST_LINE) throw tooLong(number);
    const textStart = start === 0 ? markLength(file) : start;
    yield { text: file.toString("utf8", textStart, end), number, start, end };
    start = end;
  }
}

function place(file: Buffer, byte: number, from: number): number {
  const found = file.indexOf(byte, from);
  return found < 0 ? Infinity : found;
}

/** Collects points that take one line each. */
export class LinePoints {
  readonly #file: Buffer;
  readonly #numbers = new Numbers();
  readonly #starts = new Numbers();
  readonly #ends = new Numbers();

  constructor(file: Buffer) {
    this.#file = file;
  }

  get numbers(): Float64Array<ArrayBuffer> {
    return this.#numbers.all();
  }

  get records(): Records {
    return { bytes: this.#file, start: (i) => this.#starts.at(i), end: (i) => this.#ends.at(i) };
  }

  add({ start, end }: Line, position: readonly number[]): void {
    for (const value of position) this.#numbers.push(value);
    this.#starts.push(start);
    this.#ends.push(end);
  }
}
