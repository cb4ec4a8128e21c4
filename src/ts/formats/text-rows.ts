import { countIn, fitsType, isOutOfRange, numberIn } from "./numbers.js";
import type { Contradictions } from "./contradictions.js";
import { endsEarly, lineProblem } from "./problem.js";
import { type Axes, type Field, type Group, hasLists } from "./rows.js";
import { trimmed, wordsOf } from "./text.js";

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
