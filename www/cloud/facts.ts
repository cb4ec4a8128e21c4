import type { Values } from "./values.ts";

/** A column of the file: a number for each point, or a single number that all points share. */
export interface Field {
  name: string;
  values: Values;
  /** The meaning of a category's numbers, if it is known. */
  labels?: Readonly<Record<number, string>>;
}

/** A unit of length. */
export interface Unit {
  /** Its short name, as it is written after a number. */
  name: string;
  meters: number;
}

/** The coordinate reference system that a file names. */
export interface Crs {
  name: string;
  /** The unit of x and y. `null`: it is not known, or it is an angle. */
  unit: Unit | null;
  /** The unit of z, if the file gives one of its own. */
  heightUnit: Unit | null;
  /** Whether x and y are degrees of longitude and latitude. */
  isAngular: boolean;
}

/** The parts of a LAS file that its points alone do not say. With them, the file can be written again. */
export interface LasSource {
  /** The header as it is in the file. */
  head: Uint8Array;
  format: number;
  scale: readonly [number, number, number];
  offset: readonly [number, number, number];
  /** The records before the points, such as the coordinate system, each with its own head of 54 bytes. */
  records: Uint8Array[];
  /** The descriptions of the extra columns, in the order of the file. */
  extras: { name: string; description: Uint8Array }[];
}

/** What a file says about its numbers. */
export interface FileFacts {
  /** The decimals of x, y and z, if the file gives them. */
  decimals?: [number, number, number];
  crs?: Crs;
  las?: LasSource;
  /** How many columns of the file are not kept, because they would take too much memory. */
  dropped?: number;
}

/** A point's number in a column. */
export function valueAt({ values }: Pick<Field, "values">, index: number): number {
  return values[values.length === 1 ? 0 : index]!;
}
