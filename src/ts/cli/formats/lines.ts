import { Numbers } from "./numbers.js";
import { FileProblem, type Records } from "./point-file.js";

/** A line of a text file: without its end, and where it is with its end. */
export interface Line {
  text: string;
  number: number;
  start: number;
  end: number;
}

const [LINE_FEED, RETURN] = [0x0a, 0x0d];
/** What some programs write before text in UTF-8. */
const BYTE_ORDER_MARK = /^\xef\xbb\xbf/;

/** The lines from a place on, in Latin-1, which keeps one character a byte. */
export function* linesOf(file: Buffer, from = 0, firstNumber = 1): Generator<Line> {
  const last = endOfLines(file, from);
  let start = from;
  for (let number = firstNumber; start < file.length; number++) {
    const found = file.indexOf(last, start);
    const end = found < 0 ? file.length : found + 1;
    const text = file.toString("latin1", start, end);
    yield { text: (start === 0 ? text.replace(BYTE_ORDER_MARK, "") : text).trim(), number, start, end };
    start = end;
  }
}

/** The last byte of each line, as the first one ends: in old files a return alone. */
function endOfLines(file: Buffer, from: number): number {
  const at = file.indexOf(RETURN, from);
  const feed = file.indexOf(LINE_FEED, from);
  return at >= 0 && (feed < 0 || at + 1 < feed) ? RETURN : LINE_FEED;
}

const NOT_FINITE = /^[-+]?(nan|inf|infinity)(\(.*\))?$/i;

/** A coordinate as it is written, NaN for one that is missing; undefined for what is no number. */
export function coordinate(word: string | undefined): number | undefined {
  if (word === undefined || word === "") return undefined;
  const value = Number(word);
  return Number.isFinite(value) ? value : NOT_FINITE.test(word) || !Number.isNaN(value) ? NaN : undefined;
}

/** Collects points that are one line each. */
export class LinePoints {
  readonly #file: Buffer;
  readonly #numbers = new Numbers();
  readonly #starts = new Numbers();
  readonly #ends = new Numbers();

  constructor(file: Buffer) {
    this.#file = file;
  }

  get count(): number {
    return this.#starts.length;
  }

  get numbers(): Float64Array<ArrayBuffer> {
    return this.#numbers.all();
  }

  get records(): Records {
    return { bytes: this.#file, start: (i) => this.#starts.at(i), end: (i) => this.#ends.at(i) };
  }

  /** @param words the words of the line that are its x, y and z */
  add(line: Line, words: (string | undefined)[]): void {
    for (const word of words) {
      const value = coordinate(word);
      if (value === undefined) throw new FileProblem(`line ${line.number} is not a point: "${line.text.slice(0, 60)}"`);
      this.#numbers.push(value);
    }
    this.#starts.push(line.start);
    this.#ends.push(line.end);
  }
}
