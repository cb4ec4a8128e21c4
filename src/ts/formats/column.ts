import type { NumberType, Values } from "./numbers.js";

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
