import type { CloudFile, Reading } from "./cloud-file.js";
import { type Column, newValues, type Values } from "./numbers.js";
import { FormatProblem } from "./problem.js";

/** Memory is taken for so many numbers at first. A line of a table may have any number of columns. */
const FIRST_NUMBERS = 1 << 20;
const number = new Intl.NumberFormat("en-US");

/**
 * Builds a cloud row by row. If there are more rows than `limit`, it keeps every second, every third, … row. So the
 * kept rows are spread evenly over the file, which is mostly in the order of the scan. If the number of rows is not
 * known beforehand, it first keeps all rows, and drops every second one each time the limit is reached.
 *
 *     for each row: if (builder.takes()) { const i = builder.put(x, y, z); builder.values[k][i] = …; }
 */
export class CloudBuilder {
  /** One array for each column. Write to it at the index that `put` returns. The arrays are replaced as they grow. */
  readonly values: Values[];
  #positions: Float32Array<ArrayBuffer> | Float64Array<ArrayBuffer>;
  /** Where the bytes of each point begin and end, if that is wanted. */
  #places = new Float64Array();
  #kept = 0;
  #seen = 0;
  #step = 1;
  #capacity: number;
  readonly #limit: number;
  readonly #columns: readonly Column[];

  constructor(
    precision: "float32" | "float64",
    columns: readonly Column[],
    { limit = Infinity }: Pick<Reading, "limit">,
    expected: number | null,
  ) {
    this.#limit = limit;
    this.#columns = columns;
    if (expected !== null) this.#step = Math.max(1, Math.ceil(expected / limit));
    this.#capacity = Math.max(1, Math.min(Math.floor(FIRST_NUMBERS / (3 + columns.length)), limit));
    this.#positions = newValues(precision, 3 * this.#capacity) as Float32Array<ArrayBuffer> | Float64Array<ArrayBuffer>;
    this.values = columns.map(({ type }) => newValues(type, this.#capacity));
  }

  /** Counts the next row, and returns whether it must be `put`. */
  takes(): boolean {
    const row = this.#seen++;
    if (row % this.#step !== 0) return false;
    if (this.#kept < this.#limit) return true;
    this.#halve();
    return row % this.#step === 0;
  }

  put(x: number, y: number, z: number): number {
    const at = this.#kept++;
    if (at === this.#capacity) this.#grow();
    this.#positions[3 * at] = x;
    this.#positions[3 * at + 1] = y;
    this.#positions[3 * at + 2] = z;
    return at;
  }

  /** Says where the bytes of a point are. */
  place(index: number, start: number, end: number): void {
    if (2 * index + 2 > this.#places.length) {
      this.#places = grown(this.#places, Math.max(FIRST_NUMBERS / 8, 2 * this.#places.length));
    }
    this.#places[2 * index] = start;
    this.#places[2 * index + 1] = end;
  }

  /** The number of rows so far, with those that were not kept. */
  get rows(): number {
    return this.#seen;
  }

  finish(): CloudFile {
    const positions = this.#positions.slice(0, 3 * this.#kept);
    this.#positions = this.#positions.subarray(0, 0);
    const columns = this.#columns.map(({ name, isDetail, labels }, k) => ({
      name,
      isDetail,
      labels,
      values: this.values[k]!.slice(0, this.#kept),
    }));
    this.values.length = 0;
    const notes =
      this.#step > 1 ? [`every ${ordinal(this.#step)} of its ${number.format(this.#seen)} points is shown`] : [];
    const places = this.#places;
    const records = {
      bytes: undefined,
      start: (i: number) => places[2 * i]!,
      end: (i: number) => places[2 * i + 1]!,
    };
    return { positions, columns, rows: this.#seen, notes, records };
  }

  #grow(): void {
    this.#capacity = Math.min(2 * this.#capacity, this.#limit);
    this.#positions = grown(this.#positions, 3 * this.#capacity);
    this.values.forEach((values, k) => (this.values[k] = grown(values, this.#capacity)));
  }

  #halve(): void {
    this.#step *= 2;
    this.#kept = Math.ceil(this.#kept / 2);
    for (let i = 0; i < this.#kept; i++) {
      this.#positions.copyWithin(3 * i, 6 * i, 6 * i + 3);
      for (const values of this.values) values[i] = values[2 * i]!;
    }
  }
}

export function grown<T extends Values>(values: T, length: number): T {
  const larger = allocating(length, () => new (values.constructor as new (length: number) => T)(length));
  larger.set(values);
  return larger;
}

/** Runs an allocation in JavaScript's memory. If it is refused, the file cannot be read. */
export function allocating<T>(numbers: number, allocate: () => T): T {
  try {
    return allocate();
  } catch (cause) {
    throw new FormatProblem(`there is no memory for ${number.format(numbers)} numbers`, { cause });
  }
}

function ordinal(value: number): string {
  const ending = value % 100 >= 11 && value % 100 <= 13 ? "th" : (["th", "st", "nd", "rd"][value % 10] ?? "th");
  return `${number.format(value)}${ending}`;
}
