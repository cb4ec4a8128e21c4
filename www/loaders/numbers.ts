import type { Values } from "../cloud/cloud.ts";

/** The kinds of numbers a file's rows are made of. */
export type NumberType = "int8" | "uint8" | "int16" | "uint16" | "int32" | "uint32" | "float32" | "float64";

const ARRAYS = {
  int8: Int8Array,
  uint8: Uint8Array,
  int16: Int16Array,
  uint16: Uint16Array,
  int32: Int32Array,
  uint32: Uint32Array,
  float32: Float32Array,
  float64: Float64Array,
} as const;

/** Reads one number of a row. */
export type NumberReader = (view: DataView, at: number) => number;

export function bytesOf(type: NumberType): number {
  return ARRAYS[type].BYTES_PER_ELEMENT;
}

export function newValues(type: NumberType, length: number): Values {
  return new ARRAYS[type](length);
}

export function isWhole(values: Values): boolean {
  return !(values instanceof Float32Array || values instanceof Float64Array);
}

/** `offset`: of the number in its row. */
export function numberReader(type: NumberType, offset: number, littleEndian: boolean): NumberReader {
  switch (type) {
    case "int8": return (view, at) => view.getInt8(at + offset);
    case "uint8": return (view, at) => view.getUint8(at + offset);
    case "int16": return (view, at) => view.getInt16(at + offset, littleEndian);
    case "uint16": return (view, at) => view.getUint16(at + offset, littleEndian);
    case "int32": return (view, at) => view.getInt32(at + offset, littleEndian);
    case "uint32": return (view, at) => view.getUint32(at + offset, littleEndian);
    case "float32": return (view, at) => view.getFloat32(at + offset, littleEndian);
    case "float64": return (view, at) => view.getFloat64(at + offset, littleEndian);
  } // prettier-ignore
}
