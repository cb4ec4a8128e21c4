import type { Values } from "../cloud/cloud.ts";
import type { NumberType } from "../../src/ts/formats/numbers.js";

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

export function isWhole(values: Values): boolean {
  return !(values instanceof Float32Array || values instanceof Float64Array);
}
