import type { Crs, Unit } from "../../src/ts/formats/las/crs.js";
import type { LasSource } from "../../src/ts/formats/las/details.js";
import type { Values } from "../../src/ts/formats/numbers.js";

export type { Crs, LasSource, Unit };
export { valueAt } from "../../src/ts/formats/column.js";

/** A column of the file: a number for each point, or a single number that all points share. */
export interface Field {
  name: string;
  values: Values;
  /** The meaning of a category's numbers, if it is known. */
  labels?: Readonly<Record<number, string>>;
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
