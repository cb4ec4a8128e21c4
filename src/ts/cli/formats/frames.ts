import type { CloudFile, Records } from "../../formats/cloud-file.js";
import type { ChosenColumns } from "../../formats/axes.js";
import { type PlyHeader, readPlyHeader } from "../../formats/ply.js";
import { type PcdHeader, readPcdHeader } from "../../formats/pcd.js";
import { markLength } from "../../formats/text.js";

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

/** PLY, ASCII and binary. Only the vertices are kept: faces would point to vertices that are gone. */
export function plyFrame(file: Buffer, _: CloudFile, chosen?: ChosenColumns): Frame {
  const header = readPlyHeader(file, chosen);
  const { elements, vertices } = header;
  return {
    leftOut: elements.filter((one) => one !== vertices && one.count > 0).map(({ name, count }) => `${count} × ${name}`),
    header: ({ length }) => Buffer.from(plyHeaderOf(file, header, length), "latin1"),
  };
}

/** The header for another number of points. It is in Latin-1, which keeps every byte. */
function plyHeaderOf(file: Buffer, { lines }: PlyHeader, count: number): string {
  return lines
    .filter(({ element }) => element === undefined || element === "vertex")
    .map(({ start, end }) => file.toString("latin1", start, end))
    .map((text) => text.replace(/^(\s*element\s+vertex\s+)\d+/, `$1${count}`))
    .join("");
}

/** PCD: text, binary and compressed. A compressed file is written as plain binary. */
export function pcdFrame(file: Buffer, _: CloudFile, chosen?: ChosenColumns): Frame {
  const header = readPcdHeader(file, chosen);
  return { header: ({ length }) => Buffer.from(pcdHeaderOf(file, header, length), "latin1") };
}

function pcdHeaderOf(file: Buffer, { lines, data }: PcdHeader, count: number): string {
  const values: Record<string, string> = {
    WIDTH: String(count),
    HEIGHT: "1",
    POINTS: String(count),
    DATA: data === "ascii" ? "ascii" : "binary",
  };
  return lines
    .map(({ start, end }) =>
      file.toString("latin1", start, end).replace(/^(\s*)(\w+)(\s+)\S+/, (same, indent, keyword: string, space) => {
        const value = values[keyword.toUpperCase()];
        return value === undefined ? same : `${indent}${keyword}${space}${value}`;
      }),
    )
    .join("");
}

/** XYZ, TXT, CSV and PTS: one point per line. The lines above the first point are kept. */
export function tableFrame(file: Buffer, { records }: CloudFile): Frame {
  // In Latin-1, which keeps every byte.
  const start = records.start(0);
  const head = start > markLength(file) ? file.toString("latin1", 0, start) : "";
  return { header: ({ length }) => Buffer.from(withCount(head, length), "latin1") };
}

/** The head with another number in the line that holds only the number of points. */
function withCount(head: string, count: number): string {
  return head.replace(/(^|[\r\n])([ \t\v\f]*)\d+(?=[ \t\v\f]*([\r\n]|$))/, `$1$2${count}`);
}
