import type { Axes, Field } from "../../formats/rows.js";

/** A file of points that has been read: the positions for the cloud, and the bytes of each point. */
export interface PointFile {
  /** x, y, z of one point after another, in the precision of the file. */
  positions: Float32Array<ArrayBuffer> | Float64Array<ArrayBuffer>;
  /** In words: the parts of the file that are lost when points are left out. */
  leftOut: string[];
  /** In words: which columns are x, y and z. Undefined if the columns have these names. */
  columns: string | undefined;
  /** The header of a file with these points. */
  header: (indices: Uint32Array) => Uint8Array;
  records: Records;
  /** The bytes after the points. */
  footer?: Uint8Array;
}

/** The place of each point's own bytes in a file. */
export interface Records {
  bytes: Uint8Array;
  start: (index: number) => number;
  end: (index: number) => number;
}

/** In words: which fields are x, y and z. Undefined if the fields have these names. */
export function fieldsSaid(fields: readonly Field[], axes: Axes): string | undefined {
  const names = axes.map((axis) => fields[axis]!.name);
  return names.join("").toLowerCase() === "xyz" ? undefined : `x, y and z are ${names.join(", ")}`;
}

/** Records of the same size, one after another. */
export function equalRecords(bytes: Uint8Array, from: number, size: number): Records {
  return { bytes, start: (index) => from + index * size, end: (index) => from + (index + 1) * size };
}

/** The file with only these points, in their order. Their bytes are copied unchanged. */
export function* pointsWritten({ header, records, footer }: PointFile, indices: Uint32Array): Generator<Uint8Array> {
  yield header(indices);
  let at = 0;
  while (at < indices.length) {
    const first = indices[at++]!;
    let end = records.end(first);
    while (at < indices.length && records.start(indices[at]!) === end) end = records.end(indices[at++]!);
    yield records.bytes.subarray(records.start(first), end);
  }
  if (footer !== undefined) yield footer;
}
