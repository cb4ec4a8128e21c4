// Rows of numbers that a header describes: the elements of a PLY file, the points of a PCD file.
import { bytesOf, numberReader, type NumberType } from "./numbers.js";
import { FormatProblem } from "./problem.js";

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
