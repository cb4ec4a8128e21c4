import type { NumberArray } from "../base/typed-arrays.js";

/** The types of numbers in files. */
export type NumberType = `${"int" | "uint"}${8 | 16 | 32 | 64}` | `float${32 | 64}`;

/** Numbers of one type. They have as many bytes as in the file. */
export type Values = Exclude<NumberArray, Uint8ClampedArray>;

/** The array for each type of numbers in a file. For the longest integers it does not keep all digits. */
const ARRAYS = {
  int8: Int8Array,
  uint8: Uint8Array,
  int16: Int16Array,
  uint16: Uint16Array,
  int32: Int32Array,
  uint32: Uint32Array,
  int64: Float64Array,
  uint64: Float64Array,
  float32: Float32Array,
  float64: Float64Array,
} as const;

export function newValues(type: NumberType, length: number): Values {
  return new ARRAYS[type](length);
}

/** Reads one number of a row. `at` is the beginning of the row. */
export type NumberReader = (view: DataView, at: number) => number;

export function bytesOf(type: NumberType): number {
  return Number(/\d+/.exec(type)![0]) / 8;
}

export function isWhole(type: NumberType): boolean {
  return !type.startsWith("float");
}

/** Whether single precision holds every number of these types. */
export function fitSingle(types: readonly NumberType[]): boolean {
  return types.every((type) => type === "float32" || bytesOf(type) <= 2);
}

/** @param offset the place of the number in its row, in bytes */
export function numberReader(type: NumberType, offset: number, littleEndian: boolean): NumberReader {
  switch (type) {
    case "int8": return (view, at) => view.getInt8(at + offset);
    case "uint8": return (view, at) => view.getUint8(at + offset);
    case "int16": return (view, at) => view.getInt16(at + offset, littleEndian);
    case "uint16": return (view, at) => view.getUint16(at + offset, littleEndian);
    case "int32": return (view, at) => view.getInt32(at + offset, littleEndian);
    case "uint32": return (view, at) => view.getUint32(at + offset, littleEndian);
    case "int64": return (view, at) => Number(view.getBigInt64(at + offset, littleEndian));
    case "uint64": return (view, at) => Number(view.getBigUint64(at + offset, littleEndian));
    case "float32": return (view, at) => view.getFloat32(at + offset, littleEndian);
    case "float64": return (view, at) => view.getFloat64(at + offset, littleEndian);
  } // prettier-ignore
}

const DECIMAL = /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i;
/** Words for numbers that are not finite. Some C libraries write nan(ind), 1.#QNAN or -1.#INF. */
const NOT_FINITE = /^[-+]?(nan(\(\w*\))?|inf|infinity|1\.#(inf|ind|qnan|snan)0*)$/i;

/**
 * A decimal number, or NaN for a word such as "nan" or "inf". Infinity for a number out of range, such as 1e400.
 * Undefined for any other word, for instance "0x10".
 */
export function numberIn(word: string): number | undefined {
  if (DECIMAL.test(word)) return Number(word);
  return NOT_FINITE.test(word) ? NaN : undefined;
}

/** A count in a header. It has only digits. */
export function countIn(word: string | undefined): number | undefined {
  const count = Number(word);
  return word !== undefined && /^\d+$/.test(word) && Number.isSafeInteger(count) ? count : undefined;
}

/** Whether this number is in the range of a type. */
export function fitsType(value: number, type: NumberType): boolean {
  if (!isWhole(type)) return true;
  const bits = 8 * bytesOf(type);
  const [least, most] = type.startsWith("u") ? [0, 2 ** bits - 1] : [-(2 ** (bits - 1)), 2 ** (bits - 1) - 1];
  return Number.isInteger(value) && value >= least && value <= most;
}

/** Whether a number is too large for its type of floats. NaN is no number. */
export function isOutOfRange(value: number, type: NumberType = "float64"): boolean {
  return Math.abs(type === "float32" ? Math.fround(value) : value) === Infinity;
}

/** The names of columns with four bytes of color in one number of PCD. */
export const PACKED = /^rgba?$/;

/** A file's values besides positions. Columns with the names red, green and blue are colors. */
export interface Column {
  name: string;
  type: NumberType;
  /** Nobody colors points by it. */
  isDetail?: true | undefined;
  /** The meaning of its numbers, if it is known. */
  labels?: Readonly<Record<number, string>> | undefined;
}

export interface FilledColumn extends Omit<Column, "type"> {
  values: Values;
}

/** A point's number in a column. If all points have the same, a column may hold it once. */
export function valueAt({ values }: Pick<FilledColumn, "values">, index: number): number {
  return values[values.length === 1 ? 0 : index]!;
}
