// Rows of numbers that a header describes: the elements of a PLY file, the points of a PCD file.
import {
  bytesOf,
  numberReader,
  type NumberType,
  isWhole,
  countIn,
  fitsType,
  isOutOfRange,
  numberIn,
} from "./numbers.js";
import { FormatProblem, type Contradictions, endsEarly, lineProblem } from "./problem.js";
import { trimmed, wordsOf } from "./text.js";

/** A part of each row: a number, several numbers (in PCD), or a length and then a list (in PLY). */
export interface Field {
  name: string;
  type: NumberType;
  count: number;
  /** For a list: the type of its length. */
  length?: NumberType;
}

export interface Group {
  /** The name of the rows in messages: "points", or the name of a PLY element. */
  name: string;
  count: number;
  fields: readonly Field[];
}

/** The indices of the fields or columns x, y and z. */
export type Axes = readonly [number, number, number];

export function hasLists(fields: readonly Field[]): boolean {
  return fields.some(({ length }) => length !== undefined);
}

/** The names of the fields that are several numbers. */
export function listsIn({ fields }: Group): string[] {
  return fields.flatMap(({ name, count, length }) =>
    (count > 1 || length !== undefined) && name !== "_" ? [name] : [],
  );
}

/** The number of bytes of these fields in a binary row. For a list, only the bytes of its length are counted. */
export function rowBytes(fields: readonly Field[]): number {
  return fields.reduce((sum, { type, count, length }) => sum + (length ? bytesOf(length) : count * bytesOf(type)), 0);
}

/**
 * Writes to `starts` where each field of a binary row begins, and returns where the row ends.
 * Returns undefined if the view ends before the row.
 */
export function walkRow(
  view: DataView,
  fields: readonly Field[],
  littleEndian: boolean,
  at: number,
  starts: number[],
): number | undefined {
  let place = at;
  for (let i = 0; i < fields.length; i++) {
    const { type, count, length } = fields[i]!;
    starts[i] = place;
    let values = count;
    if (length) {
      if (place + bytesOf(length) > view.byteLength) return undefined;
      values = numberReader(length, 0, littleEndian)(view, place);
      if (values < 0) throw new FormatProblem(`the length of a list is ${values}`);
      place += bytesOf(length);
    }
    place += values * bytesOf(type);
    if (place > view.byteLength) return undefined;
  }
  return place;
}

/** In words: which fields are x, y and z. Undefined if the fields have these names. */
export function fieldsSaid(fields: readonly Field[], axes: Axes): string | undefined {
  const names = axes.map((axis) => fields[axis]!.name);
  return names.join("").toLowerCase() === "xyz" ? undefined : `x, y and z are ${names.join(", ")}`;
}

/** The largest number of rows that are checked. */
export const ORDER_SAMPLE = 1000;

/**
 * Refuses rows in the wrong byte order. Such rows have many numbers that are far larger or smaller
 * than any measured number. In the other byte order, they have almost none.
 */
export function checkByteOrder(rows: DataView, fields: readonly Field[], axes: Axes, littleEndian: boolean): void {
  if (hasLists(fields)) return;
  const size = rowBytes(fields);
  const count = Math.min(ORDER_SAMPLE, Math.floor(rows.byteLength / size));
  const odd = (little: boolean) => {
    let number = 0;
    for (const axis of axes.filter((each) => !isWhole(fields[each]!.type))) {
      const read = numberReader(fields[axis]!.type, rowBytes(fields.slice(0, axis)), little);
      for (let row = 0; row < count; row++) if (isOdd(read(rows, row * size))) number++;
    }
    return number / (3 * count);
  };
  if (count === 0 || odd(littleEndian) < 0.3 || odd(!littleEndian) > 0.01) return;
  const other = littleEndian ? "big" : "little";
  throw new FormatProblem(`its numbers are ${other}-endian, but its header says the opposite`);
}

function isOdd(value: number): boolean {
  const size = Math.abs(value);
  return !(size < 1e15) || (size > 0 && size < 1e-20);
}

/** A point of a text file. */
export interface TextPoint {
  position: readonly [number, number, number];
  /** The number of a field. */
  value: (field: number) => number;
}

/**
 * Takes the lines after a header, one row each, and checks all of them. A row with too few values
 * is refused, because its later values would stand for other fields.
 */
export class TextRows {
  readonly #groups: readonly Group[];
  readonly #points: Group;
  readonly #axes: Axes;
  #group = 0;
  #row = 0;

  constructor(groups: readonly Group[], points: Group, axes: Axes) {
    [this.#groups, this.#points, this.#axes] = [groups, points, axes];
  }

  /** The point of this line. Undefined for a blank line, and for a row that is not a point. */
  take(text: string, number: number): TextPoint | undefined {
    const line = trimmed(text);
    if (line === "") return undefined;
    while (this.#isDone()) this.#next();
    const group = this.#groups[this.#group];
    if (group === undefined) throw lineProblem(number, "comes after the last row that the header promises", line);
    this.#row++;
    const words = wordsOf(line);
    const starts = startsIn(group.fields, words, number, line);
    if (group !== this.#points) return undefined;
    const value = (field: number) => this.#number(words[starts[field]!]!, field, number, line);
    return { position: this.#axes.map(value) as [number, number, number], value };
  }

  /** Must be called after the last line. */
  finish(found: Contradictions): void {
    while (this.#group < this.#groups.length) {
      const { name, count } = this.#groups[this.#group]!;
      if (!this.#isDone()) found.add(endsEarly(this.#row, count, name).message);
      this.#next();
    }
  }

  /** Whether all rows of the group were read. An element without properties has no lines. */
  #isDone(): boolean {
    const group = this.#groups[this.#group];
    return group !== undefined && (this.#row === group.count || group.fields.length === 0);
  }

  #next(): void {
    this.#group++;
    this.#row = 0;
  }

  /** A text keeps all digits, also where its header says that the number is a float. */
  #number(word: string, field: number, number: number, line: string): number {
    const value = numberIn(word);
    const { name, type } = this.#points.fields[field]!;
    if (value === undefined) throw lineProblem(number, `is not a point, its ${name} is not a number`, line);
    if (isOutOfRange(value)) throw lineProblem(number, `has a ${name} that is out of range`, line);
    if (!fitsType(value, type)) throw lineProblem(number, `is not a point, its ${name} is not of type ${type}`, line);
    return value;
  }
}

const FIXED = new WeakMap<readonly Field[], { starts: number[]; total: number } | null>();

/** Returns the index of each field's first word. Refuses a line with too few or too many words. */
export function startsIn(
  fields: readonly Field[],
  words: readonly string[],
  number: number,
  line: string,
): readonly number[] {
  let known = FIXED.get(fields);
  if (known === undefined) FIXED.set(fields, (known = hasLists(fields) ? null : walk(fields, [], number, line)));
  const { starts, total } = known ?? walk(fields, words, number, line);
  if (words.length !== total) {
    throw lineProblem(number, `has ${words.length} values, and its header promises ${total}`, line);
  }
  return starts;
}

function walk(
  fields: readonly Field[],
  words: readonly string[],
  number: number,
  line: string,
): { starts: number[]; total: number } {
  let total = 0;
  const starts = fields.map(({ count, length }) => {
    const start = total;
    const word = words[start] ?? "0";
    if (length && countIn(word) === undefined) {
      throw lineProblem(number, `is a row whose list has a length of ${word}`, line);
    }
    total += length ? 1 + Number(word) : count;
    return start;
  });
  return { starts, total };
}
