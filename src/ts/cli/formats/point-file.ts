import type { Axes, Field } from "../../formats/rows.js";

/** A file of points as it was read: what the cloud is made of, and what was written about each point. */
export interface PointFile {
  /** x, y, z of one point after another, in the precision of the file. */
  positions: Float32Array<ArrayBuffer> | Float64Array<ArrayBuffer>;
  /** What a file of fewer points cannot keep, in words. */
  leftOut: string[];
  /** Which columns are x, y and z, in words, where the file does not call them so. */
  columns: string | undefined;
  /** The header of a file of so many points. */
  header: (count: number) => Uint8Array;
  records: Records;
}

/** Where in a file each point's own bytes are. */
export interface Records {
  bytes: Uint8Array;
  start: (index: number) => number;
  end: (index: number) => number;
}

/** Which fields are x, y and z, unless they are called so. */
export function fieldsSaid(fields: readonly Field[], axes: Axes): string | undefined {
  const names = axes.map((axis) => fields[axis]!.name);
  return names.join("").toLowerCase() === "xyz" ? undefined : `x, y and z are ${names.join(", ")}`;
}

/** What takes so many bytes for each point, one after another. */
export function equalRecords(bytes: Uint8Array, from: number, size: number): Records {
  return { bytes, start: (index) => from + index * size, end: (index) => from + (index + 1) * size };
}

/** The file with only these points, in their order; their bytes are copied as they are. */
export function* written({ header, records }: PointFile, indices: Uint32Array): Generator<Uint8Array> {
  yield header(indices.length);
  let at = 0;
  while (at < indices.length) {
    const first = indices[at++]!;
    let end = records.end(first);
    while (at < indices.length && records.start(indices[at]!) === end) end = records.end(indices[at++]!);
    yield records.bytes.subarray(records.start(first), end);
  }
}
