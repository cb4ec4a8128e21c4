/** The types of numbers in binary files, by the method of DataView that reads them. */
export type NumberType =
  "Int8" | "Uint8" | "Int16" | "Uint16" | "Int32" | "Uint32" | "BigInt64" | "BigUint64" | "Float32" | "Float64";

export function sizeOf(type: NumberType): number {
  return Number(/\d+/.exec(type)![0]) / 8;
}

export function viewOf(bytes: Uint8Array): DataView {
  return new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
}

/** Reads numbers of one type. */
export function reader(view: DataView, type: NumberType, littleEndian: boolean): (at: number) => number {
  return (at) => Number(view[`get${type}`](at, littleEndian));
}

/** Room for points, in single precision where their coordinates are. */
export function roomFor(count: number, types: NumberType[]): Float32Array<ArrayBuffer> | Float64Array<ArrayBuffer> {
  const single = types.every((type) => type === "Float32");
  return single ? new Float32Array(3 * count) : new Float64Array(3 * count);
}
