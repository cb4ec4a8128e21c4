import { type FormatProblem, lineProblem, several } from "./problem.js";

/** A line of a file: the place where it begins, and the place where the next one begins. */
export interface Line {
  text: string;
  /** Counted from 1. */
  number: number;
  start: number;
  end: number;
}

/** The longest line of points. JavaScript engines end a program that makes a string of some 500 MB. */
export const LONGEST_LINE = 1 << 20;

const [LINE_FEED, RETURN] = [0x0a, 0x0d];
const BYTE_ORDER_MARK = [0xef, 0xbb, 0xbf];

/** Each byte as the character of its number. A decoder of "latin1" has other characters from 0x80 to 0x9f, but for old Node. */
export function byteText(bytes: Uint8Array): string {
  return Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");
}

/** The text without blanks at its ends. Only ASCII blanks count, so that all encodings give the same lines. */
export function trimmed(text: string): string {
  return text.replace(/^[ \t\v\f\r\n]+|[ \t\v\f\r\n]+$/g, "");
}

/** The words of a trimmed line. */
export function wordsOf(text: string): string[] {
  return text === "" ? [] : text.split(/[ \t\v\f]+/);
}

export function tooLong(line: number): FormatProblem {
  return lineProblem(line, `is longer than ${LONGEST_LINE / (1 << 20)} MB`);
}

/** The length of a UTF-8 byte order mark at the beginning, in bytes. */
export function markLength(bytes: Uint8Array): number {
  return BYTE_ORDER_MARK.every((byte, i) => bytes[i] === byte) ? BYTE_ORDER_MARK.length : 0;
}

/** Whether this is not text. The only control characters of text are tabs and line ends. */
export function looksBinary(start: Uint8Array): boolean {
  return start.some((byte) => byte < 0x09 || (byte > 0x0d && byte < 0x20));
}

/**
 * The trimmed lines of a header. All lines must have the same line end as the first line, because a
 * carriage return may be the first byte after the header.
 */
export function* headerLines(start: Uint8Array): Generator<Line> {
  const decoder = new TextDecoder();
  const mark = markLength(start);
  const back = start.indexOf(RETURN, mark);
  const feed = start.indexOf(LINE_FEED, mark);
  const last = back >= 0 && (feed < 0 || back + 1 < feed) ? RETURN : LINE_FEED;
  for (let from = mark, number = 1; from < start.length; number++) {
    const found = start.indexOf(last, from);
    const end = found < 0 ? start.length : found + 1;
    yield { text: trimmed(decoder.decode(start.subarray(from, end))), number, start: number === 1 ? 0 : from, end };
    from = end;
  }
}

/** A file may end in blanks or zeros, which some programs add. Of any other content, a sentence is returned. */
export function restSays(rest: Uint8Array, name: string): string | undefined {
  const blank = rest.every((byte) => byte === 0 || byte === 0x20 || (byte >= 0x09 && byte <= 0x0d));
  return blank ? undefined : `it goes on after the last of the ${several(name)} that its header promises`;
}
