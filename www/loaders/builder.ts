import type { LoadedCloud, Values } from "../cloud/cloud.ts";
import type { NumberType } from "../../src/ts/formats/numbers.js";
import { attributesOf } from "./attributes.ts";
import type { Reading } from "./blocks.ts";
import { newValues } from "./numbers.ts";

/** A file's values besides positions. Columns with the names red, green and blue become the colors. */
export interface Column {
  name: string;
  type: NumberType;
  /** Nobody colors points by it. */
  isDetail?: true;
}

const FIRST_CAPACITY = 65_536;
/** Points are shown while they are read: the first ones, then so many at a time, but not more than the last number. */
const FIRST_SHOWN = 10_000;
const NEXT_SHOWN = 150_000;
const MOST_SHOWN = 4_000_000;
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
  #positions: Float32Array | Float64Array;
  #kept = 0;
  #seen = 0;
  #step = 1;
  #capacity: number;
  readonly #limit: number;
  readonly #onPoints: Reading["onPoints"];
  /** How many points have been handed on, and the number at which the next ones are. */
  #shown = 0;
  #showAt = FIRST_SHOWN;
  readonly #columns: readonly Column[];

  constructor(
    precision: "float32" | "float64",
    columns: readonly Column[],
    { limit, onPoints }: Pick<Reading, "limit" | "onPoints">,
    expected: number | null,
  ) {
    this.#limit = limit;
    this.#onPoints = onPoints;
    this.#columns = columns;
    if (expected !== null) this.#step = Math.max(1, Math.ceil(expected / limit));
    this.#capacity = Math.min(FIRST_CAPACITY, limit);
    this.#positions = newValues(precision, 3 * this.#capacity) as Float32Array | Float64Array;
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
    if (this.#kept >= this.#showAt) this.#show();
    return at;
  }

  /** The number of rows so far, with those that were not kept. */
  get rows(): number {
    return this.#seen;
  }

  finish(): LoadedCloud {
    const positions = this.#positions.slice(0, 3 * this.#kept);
    this.#positions = this.#positions.subarray(0, 0);
    const columns = this.#columns.map(({ name, isDetail }, k) => ({
      name,
      isDetail,
      values: this.values[k]!.slice(0, this.#kept),
    }));
    this.values.length = 0;
    const notes =
      this.#step > 1 ? [`Every ${ordinal(this.#step)} of its ${number.format(this.#seen)} points is shown.`] : [];
    return { positions, ...attributesOf(columns), notes };
  }

  /** Hands on the points since the last time. Differences are taken in f64, so that f32 holds them. */
  #show(): void {
    // Their number doubles, because every picture of all points so far takes time.
    this.#showAt = this.#kept + Math.max(NEXT_SHOWN, this.#kept);
    if (!this.#onPoints || this.#kept > MOST_SHOWN) return;
    const points = new Float32Array(3 * (this.#kept - this.#shown));
    const from = 3 * this.#shown;
    for (let i = 0; i < points.length; i++) points[i] = this.#positions[from + i]! - this.#positions[i % 3]!;
    this.#shown = this.#kept;
    this.#onPoints(points, [this.#positions[0]!, this.#positions[1]!, this.#positions[2]!]);
  }

  #grow(): void {
    this.#capacity = Math.min(2 * this.#capacity, this.#limit);
    this.#positions = grown(this.#positions, 3 * this.#capacity);
    this.values.forEach((values, k) => (this.values[k] = grown(values, this.#capacity)));
  }

  #halve(): void {
    this.#step *= 2;
    this.#kept = Math.ceil(this.#kept / 2);
    [this.#shown, this.#showAt] = [this.#kept, this.#kept + NEXT_SHOWN];
    for (let i = 0; i < this.#kept; i++) {
      this.#positions.copyWithin(3 * i, 6 * i, 6 * i + 3);
      for (const values of this.values) values[i] = values[2 * i]!;
    }
  }
}

function grown<T extends Values>(values: T, length: number): T {
  const larger = new (values.constructor as new (length: number) => T)(length);
  larger.set(values);
  return larger;
}

function ordinal(value: number): string {
  const ending = value % 100 >= 11 && value % 100 <= 13 ? "th" : (["th", "st", "nd", "rd"][value % 10] ?? "th");
  return `${number.format(value)}${ending}`;
}
