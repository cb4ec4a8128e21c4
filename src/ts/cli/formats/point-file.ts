import type { CloudFile, Records } from "../../formats/cloud-file.js";

/** A file of points that has been read, and how its points are written. */
export interface PointFile extends CloudFile, Frame {
  records: Required<Records>;
}

/** The parts of a file around its points. */
export interface Frame {
  /** In words: the parts of the file that are lost when points are left out. */
  leftOut?: string[];
  /** The header of a file with these points. Formats without one are not written. */
  header?: (indices: Uint32Array) => Uint8Array;
  /** The bytes after the points. */
  footer?: Uint8Array;
}

/** The file with only these points, in their order. Their bytes are copied unchanged. */
export function* pointsCopied({ header, records, footer }: PointFile, indices: Uint32Array): Generator<Uint8Array> {
  yield header!(indices);
  let at = 0;
  while (at < indices.length) {
    const first = indices[at++]!;
    let end = records.end(first);
    while (at < indices.length && records.start(indices[at]!) === end) end = records.end(indices[at++]!);
    yield records.bytes!.subarray(records.start(first), end);
  }
  if (footer !== undefined) yield footer;
}
