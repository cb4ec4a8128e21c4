import type { FilledColumn } from "../column.js";

/** Points, their numbers, and those that are to be written. */
export interface Content {
  positions: Float32Array | Float64Array;
  /** Three bytes for each point. */
  colors: Uint8Array | null;
  fields: readonly FilledColumn[];
  indices: Uint32Array;
}

/** The number of points that are written together. On a page, this takes less time than a frame. */
export const BATCH = 8192;
