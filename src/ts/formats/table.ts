import { type ChosenColumns, isNumber } from "./axes.js";
import { type Contradictions, FormatProblem, lineProblem } from "./problem.js";
import { isOutOfRange } from "./numbers.js";
import type { Axes } from "./rows.js";
import {
  areDegrees,
  areUnits,
  axesIn,
  type Names,
  namesIn,
  cell,
  isComment,
  type Separator,
  separatorOf,
  split,
} from "./table-words.js";
import { trimmed } from "./text.js";

/** How the lines of a table are read. */
export interface Layout {
  separator: Separator;
  /** The number of words in each line. */
  width: number;
  axes: Axes;
  /** The names of the columns, if the file has them. */
  names: Names | undefined;
}

export interface TablePoint {
  position: readonly [number, number, number];
  words: readonly string[];
}

/** The largest number of lines above the points: a title or names, and units. Comments are not counted. */
const MOST_HEAD_LINES = 2;
const NOT_PROJECTED = "names longitude and latitude: degrees must be projected to meters first, for example to UTM";
/** Enough points to see that they are numbered. */
const LEAST_NUMBERED = 3;

/**
 * Takes the lines of a table, one point each. Spaces, tabs, commas or semicolons divide the words.
 * Numbers have decimal points or commas. Above the points there may be their number, a line of
 * names, a line of units, and comments.
 */
export class TableRows {
  readonly #chosen: ChosenColumns | undefined;
  readonly #byNumber: boolean;
  #layout: Layout | undefined;
  #count = 0;
  #promised: { count: number; line: number } | undefined;
  #names: (Names & { line: number; axes: Axes }) | undefined;
  #headLines = 0;
  /** The names in a comment. */
  #commented: Names | undefined;
  #comments: { text: string; line: number }[] = [];
  #decimal: { mark: "." | ","; line: number } | undefined;

  constructor(chosen?: ChosenColumns) {
    this.#chosen = chosen;
    this.#byNumber = chosen?.every(isNumber) ?? false;
  }

  /** Undefined before the first point. */
  get layout(): Layout | undefined {
    return this.#layout;
  }

  /**
   * The point of this line. Undefined for a line that is not a point.
   *
   * @param following this line and some after it. Without them, the first column is taken as x even if it numbers the points
   */
  take(text: string, number: number, following = (): readonly string[] => []): TablePoint | undefined {
    const line = trimmed(text);
    if (line === "") return undefined;
    if (isComment(line)) {
      if (this.#layout === undefined) this.#comments.push({ text: line, line: number });
      return undefined;
    }
    this.#layout ??= this.#begin(line, untrimmed(text), number, following);
    if (this.#layout === undefined) return undefined;
    const { width, axes } = this.#layout;
    const words = rowWords(text, this.#layout);
    if (words === undefined) throw lineProblem(number, "has a quotation mark without an end", line);
    if (words.length !== width) {
      throw lineProblem(number, `is not a point, it has ${words.length} columns and lines above have ${width}`, line);
    }
    this.#count++;
    const coordinate = (axis: number) => this.#coordinate(words[axis]!, axis, number, line);
    return { position: [coordinate(axes[0]), coordinate(axes[1]), coordinate(axes[2])], words };
  }

  /** Must be called after the last line. */
  finish(found: Contradictions): void {
    if (this.#count === 0) throw new FormatProblem("it has no line of three numbers");
    if (this.#promised !== undefined && this.#promised.count !== this.#count) {
      const { line, count } = this.#promised;
      found.add(`line ${line} promises ${count} points, and there are ${this.#count}`);
    }
  }

  #split(line: string, separator: Separator, number: number): string[] {
    const words = split(line, separator);
    if (words === undefined) throw lineProblem(number, "has a quotation mark without an end", line);
    return words;
  }

  #coordinate(word: string, axis: number, number: number, line: string): number {
    const found = cell(word);
    if (found === undefined) throw lineProblem(number, `is not a point, its column ${axis + 1} is not a number`, line);
    if (found.decimal !== undefined) {
      this.#decimal ??= { mark: found.decimal, line: number };
      if (this.#decimal.mark !== found.decimal) {
        throw lineProblem(number, `has both decimal points and decimal commas with line ${this.#decimal.line}`, line);
      }
    }
    if (isOutOfRange(found.value)) throw lineProblem(number, `has a number out of range in column ${axis + 1}`, line);
    return found.value;
  }

  /** Returns the layout if this line is the first point. Otherwise, the line belongs to the head. */
  #begin(line: string, whole: string, number: number, following: () => readonly string[]): Layout | undefined {
    if (/^\d+$/.test(line) && this.#promised === undefined && this.#names === undefined) {
      this.#promised = { count: Number(line), line: number };
      return undefined;
    }
    const separator = this.#names?.separator === "\t" && line.includes("\t") ? "\t" : separatorOf(line);
    const words = this.#split(separator === "\t" ? whole : line, separator, number);
    if (words.length > 3 && words.at(-1) === "" && this.#names?.written.length === words.length - 1) words.pop();
    const isNumberAt = (axis: number) => words[axis] !== undefined && cell(words[axis]) !== undefined;
    const numbers = words.filter((word) => word !== "" && cell(word) !== undefined).length;

    if (this.#names !== undefined) {
      const { axes, written, line: above } = this.#names;
      if (words.length === written.length && axes.every(isNumberAt)) {
        return this.#layoutOf(line, number, separator, words, axes);
      }
      if (++this.#headLines < MOST_HEAD_LINES && words.length === written.length && areUnits(words, axes)) {
        return undefined;
      }
      if (words.length !== written.length) {
        throw lineProblem(number, `has ${words.length} columns, and line ${above} names ${written.length}`, line);
      }
      throw lineProblem(number, "is not a point", line);
    }
    if (this.#byNumber) {
      const axes = this.#chosen!.map((column) => Number(column) - 1) as unknown as Axes;
      if (axes.every((axis) => words[axis] !== "" && isNumberAt(axis))) {
        return this.#layoutOf(line, number, separator, words, axes);
      }
      if (++this.#headLines > MOST_HEAD_LINES) throw lineProblem(number, "is not a point", line);
      return undefined;
    }
    if (numbers >= 3) {
      const axes = this.#axesInComments(words.length, separator);
      const rows = this.#commented ? [] : rowsIn(following(), { separator, width: words.length });
      return this.#layoutOf(line, number, separator, words, areNumbered(rows) ? [1, 2, 3] : axes);
    }

    const names = namesIn(line);
    const axes = axesIn(names, this.#chosen);
    if (axes === undefined && areDegrees(names)) throw lineProblem(number, NOT_PROJECTED, line);
    if (axes === undefined) throw lineProblem(number, "is neither three numbers nor names of columns x, y and z", line);
    this.#names = { ...names, line: number, axes };
    return undefined;
  }

  #layoutOf(line: string, number: number, separator: Separator, words: readonly string[], axes: Axes): Layout {
    if (separator === "," && !line.includes(".") && this.#names === undefined && areCommasUnclear(line)) {
      throw lineProblem(number, "has commas that may divide numbers or decimals", line);
    }
    return { separator, width: words.length, axes, names: this.#names ?? this.#commented };
  }

  /** Finds x, y and z by the names in a comment above the points. Without names, takes the first three columns. */
  #axesInComments(width: number, separator: Separator): Axes {
    for (const { text, line } of this.#comments.reverse()) {
      const names = namesIn(text, separator);
      const fits = names.written.length === width;
      const axes = this.#chosen && !fits ? undefined : axesIn(names, this.#chosen);
      if (axes === undefined && fits && areDegrees(names)) throw lineProblem(line, NOT_PROJECTED, text);
      if (axes === undefined && fits && width > 3) {
        throw lineProblem(line, "may name the columns, but not which are x, y and z", text);
      }
      if (axes === undefined) continue;
      if (!fits && axes.join() === "0,1,2") continue;
      if (!fits) throw lineProblem(line, `names ${names.written.length} columns, and the points have ${width}`, text);
      this.#commented = names;
      return axes;
    }
    if (this.#chosen) throw new FormatProblem(`it names no columns ${this.#chosen.join(", ")}`);
    return [0, 1, 2];
  }
}

/**
 * Whether it is unclear if the commas are separators or decimal commas. "1,5, 2,5" has commas with
 * and without spaces. "1,05,2,07" has numbers with a leading 0.
 */
function areCommasUnclear(line: string): boolean {
  return (/\d,\d/.test(line) && /\d,\s/.test(line)) || /,0\d/.test(line);
}

/**
 * Whether the first column numbers the points: it has consecutive integers, and three more columns are numbers. Rising
 * integers with gaps are numbers of points if all numbers in the three columns have decimals. Where y is
 * the same everywhere, the points may be a row of a grid, and where six columns end with bytes, these are colors.
 */
function areNumbered(rows: readonly string[][]): boolean {
  const [first] = rows;
  const hasGaps = rows.every((row) => [1, 2, 3].every((column) => cell(row[column] ?? "")?.decimal !== undefined));
  return (
    first !== undefined &&
    first.length > 3 &&
    rows.length >= LEAST_NUMBERED &&
    rows.every(
      (row, i) =>
        /^\d+$/.test(row[0]!) &&
        (Number(row[0]) === Number(first[0]) + i ||
          (hasGaps && (i === 0 || Number(row[0]) > Number(rows[i - 1]![0])))) &&
        [1, 2, 3].every((column) => cell(row[column] ?? "") !== undefined),
    ) &&
    rows.some((row) => row[1] !== first[1]) &&
    !(first.length === 6 && rows.every((row) => row.slice(3).every(isByte)))
  );
}

export function isByte(word: string): boolean {
  return /^\d{1,3}$/.test(word) && Number(word) <= 255;
}

/** The words of these lines, as far as they are points. */
export function rowsIn(texts: readonly string[], layout: Pick<Layout, "separator" | "width">): string[][] {
  return texts
    .filter((line) => trimmed(line) !== "" && !isComment(trimmed(line)))
    .map((line) => rowWords(line, layout) ?? []);
}

/** The words of a line below the head; undefined if a quotation mark has no end. */
function rowWords(text: string, { separator, width }: Pick<Layout, "separator" | "width">): string[] | undefined {
  const words = split(separator === "\t" ? untrimmed(text) : trimmed(text), separator);
  // A separator may stand at the end of a line.
  if (words?.length === width + 1 && words.at(-1) === "") words.pop();
  return words;
}

/** Whether the choice of columns is obvious: they are called x, y and z, or there are no others. */
export function isPlain({ axes, names, width }: Layout): boolean {
  if (names === undefined) return width === 3;
  return axes.map((axis) => names.bare[axis]).join("") === "xyz";
}

/** Removes only the line end. Tabs at both ends stay, since empty words may stand there. */
function untrimmed(text: string): string {
  return text.replace(/[\r\n]+$/, "");
}

/** In words: the columns that are read. */
export function columnsSaid({ axes, names }: Layout): string {
  const numbers = axes.map((axis) => axis + 1).join(", ");
  const called = names === undefined ? "" : ` (${axes.map((axis) => names.written[axis]!).join(", ")})`;
  return `x, y and z are columns ${numbers}${called}`;
}
