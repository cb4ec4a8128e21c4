import { extname } from "node:path";

import { type CloudFile, ENDINGS, type Format as Holds, type Reading, type Records } from "../formats/cloud-file.js";
import type { ChosenColumns } from "../formats/axes.js";
import { type PlyHeader, readPlyHeader } from "../formats/ply.js";
import { type PcdHeader, readPcdHeader } from "../formats/pcd.js";
import { markLength } from "../formats/text.js";
import {
  LAS_RECORD_HEADER,
  type LasHeader,
  lasPosition,
  lasRecords,
  LONGEST_LAS_HEADER,
  readLasHeader,
} from "../formats/las/header.js";
import { bytesSource, viewOf } from "../formats/source.js";
import { contentOf, type WrittenFormat } from "../formats/write/content.js";
import { finestScale, lasParts } from "../formats/write/las.js";
import { plyParts } from "../formats/write/ply.js";
import type { Transferred } from "../cloud/transfer.js";
import { DEGREES } from "../formats/las/read-las.js";
import { FormatProblem } from "../formats/problem.js";
import { readFile } from "../formats/read.js";
import { sourceOf } from "../files/source-of.js";
import { compileFiles } from "../files/wasm.js";

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

// LAS, LAZ and COPC. All are written as LAS.

/** The places in the header (LAS Specification 1.4 R15, table 3). */
const [COUNT, COUNTS_BY_RETURN, BOUNDS, WAVES, EXTENDED, WIDE_COUNT, WIDE_BY_RETURN] = [
  107, 111, 179, 227, 235, 247, 255,
];
/** The extended record with the wave forms. */
const WAVE_FORMS = 65_535;

export function lasFrame(file: Buffer, { records }: CloudFile): Frame {
  const header = readLasHeader(file.subarray(0, LONGEST_LAS_HEADER));
  const extended = extendedRecords(file, header);
  const rows = records.bytes!.subarray(records.start(0));
  return {
    header: (indices) => headerOf(file, header, viewOf(rows), indices, extended),
    footer: Buffer.concat(extended.map(({ bytes }) => bytes)),
  };
}

/** The header, and the records after it, of a file with these points. */
function headerOf(
  file: Buffer,
  header: LasHeader,
  rows: DataView,
  indices: Uint32Array,
  extended: readonly ExtendedRecord[],
): Uint8Array {
  const { headerBytes, minor, format, rowBytes } = header;
  // The records of LAZ and COPC describe how the points were compressed.
  const records = header.records.filter(({ user }) => user !== "laszip encoded" && user !== "copc");
  const bytes = Buffer.concat([
    file.subarray(0, headerBytes),
    ...records.map(({ at, length }) => file.subarray(at - LAS_RECORD_HEADER.before, at + length)),
  ]);
  const start = bytes.length;
  bytes.writeUInt32LE(start, 96);
  bytes.writeUInt32LE(records.length, 100);
  bytes.writeUInt8(format, 104);

  const returns = new Array<number>(15).fill(0);
  const bits = format >= 6 ? 15 : 7;
  for (const index of indices) {
    const number = rows.getUint8(index * rowBytes + 14) & bits;
    if (number > 0) returns[number - 1]!++;
  }
  // Files with the formats from 6 on, or too many points, have zeros in the old fields.
  const isOld = minor < 4 || file.readUInt32LE(COUNT) > 0;
  bytes.writeUInt32LE(isOld ? indices.length : 0, COUNT);
  for (let i = 0; i < 5; i++) bytes.writeUInt32LE(isOld ? returns[i]! : 0, COUNTS_BY_RETURN + 4 * i);
  boundsOf(header, rows, indices).forEach((bound, i) => bytes.writeDoubleLE(bound, BOUNDS + 8 * i));
  if (minor < 3 || headerBytes < EXTENDED) return bytes;

  const end = start + indices.length * rowBytes;
  const before = (record: number) => extended.slice(0, record).reduce((sum, one) => sum + one.bytes.length, 0);
  const waves = extended.findIndex(({ user, id }) => user === "LASF_Spec" && id === WAVE_FORMS);
  bytes.writeBigUInt64LE(BigInt(waves < 0 ? 0 : end + before(waves)), WAVES);
  if (minor < 4) return bytes;
  bytes.writeBigUInt64LE(BigInt(extended.length === 0 ? 0 : end), EXTENDED);
  bytes.writeUInt32LE(extended.length, EXTENDED + 8);
  bytes.writeBigUInt64LE(BigInt(indices.length), WIDE_COUNT);
  returns.forEach((number, i) => bytes.writeBigUInt64LE(BigInt(number), WIDE_BY_RETURN + 8 * i));
  return bytes;
}

/** The highest and the lowest x, y and z, in the order of the header. */
function boundsOf(header: LasHeader, rows: DataView, indices: Uint32Array): number[] {
  const bounds = [-Infinity, Infinity, -Infinity, Infinity, -Infinity, Infinity];
  for (const index of indices) {
    lasPosition(header, rows, index * header.rowBytes).forEach((value, axis) => {
      bounds[2 * axis] = Math.max(bounds[2 * axis]!, value);
      bounds[2 * axis + 1] = Math.min(bounds[2 * axis + 1]!, value);
    });
  }
  return bounds.map((bound) => (Number.isFinite(bound) ? bound : 0));
}

interface ExtendedRecord {
  user: string;
  id: number;
  bytes: Uint8Array;
}

/** The records after the points, without the octree of COPC. Records that do not fit into the file are left out. */
function extendedRecords(file: Buffer, { minor }: LasHeader): ExtendedRecord[] {
  if (minor === 3) {
    // The wave forms are the only such record of this version, and nothing counts it.
    const at = Number(file.readBigUInt64LE(WAVES));
    const isThere = at > 0 && at + LAS_RECORD_HEADER.after <= file.length;
    return isThere ? [{ user: "LASF_Spec", id: WAVE_FORMS, bytes: file.subarray(at) }] : [];
  }
  if (minor < 4) return [];
  const start = Number(file.readBigUInt64LE(EXTENDED));
  if (start === 0) return [];
  const view = new DataView(file.buffer, file.byteOffset, file.byteLength);
  return lasRecords(view, start, file.readUInt32LE(EXTENDED + 8), "after")
    .filter(({ user }) => user !== "copc")
    .map(({ user, id, at, length }) => ({
      user,
      id,
      bytes: file.subarray(at - LAS_RECORD_HEADER.after, at + length),
    }));
}

// Writes points in another format than the one they were read from.

/** The endings of files that the points of all formats can be written to. */
export const CONVERTED: readonly string[] = [".ply", ".las"];

/** The points in another format, and what is changed. */
export function converted(
  file: PointFile,
  indices: Uint32Array,
  ending: string,
): { parts: Iterable<Uint8Array>; notes: string[] } {
  const format = ending.slice(1) as WrittenFormat;
  const { content, notes } = contentOf(file, format, indices);
  const comments = file.crs ? [`CRS ${file.crs.name}`] : [];
  return { parts: format === "las" ? lasParts(content) : plyParts(content, comments), notes };
}

/** In words: what a file in another format lacks. */
export function lost(file: PointFile, ending: string): string[] {
  const { las, crs, leftOut = [], unread = [], positions } = file;
  const said = [...leftOut, ...unread];
  if (ending === ".las") {
    const all = Uint32Array.from({ length: positions.length / 3 }, (_, i) => i);
    const scale = finestScale(contentOf(file, "las", all).content).scale[0];
    // A number near enough that its decimal digits are the same.
    const isKept = (value: number) =>
      !(Math.abs(Math.round(value / scale) * scale - value) > 4 * Number.EPSILON * Math.abs(value));
    return positions.every(isKept) ? said : [...said, `digits of coordinates beyond ${scale}`];
  }
  if (crs) said.push(`the coordinate system, but for its name ${crs.name}`);
  if (las && las.records.length > 0) said.push(`${las.records.length} × record of LAS`);
  return said;
}

/**
 * A binary PLY file of all points in their order, each with its color, or its value if there is one channel, and with the
 * number of cameras that see it. What no camera sees is black, or NaN, and its `seen` is 0.
 */
export function coloredPly(
  positions: Float32Array | Float64Array,
  { values, channels, seen }: Transferred,
): Iterable<Uint8Array> {
  const isColor = channels >= 3;
  return plyParts({
    positions,
    colors: isColor
      ? new Uint8Array(3 * seen.length).map((_, i) => Math.round(values[channels * Math.floor(i / 3) + (i % 3)]! || 0))
      : null,
    fields: [...(isColor ? [] : [{ name: "value", values }]), { name: "seen", values: seen }],
    indices: new Uint32Array(seen.length).map((_, i) => i),
  });
}

interface Format {
  /** What the file must hold. */
  holds: Holds;
  frame?: (file: Buffer, cloud: CloudFile, chosen?: ChosenColumns) => Frame;
  /** Whether the user can choose the columns. */
  hasColumns: boolean;
  /** The endings of files that its points are copied to, as they are. Without any, they are written in another format. */
  written: readonly string[];
}

const ALL = Object.entries(ENDINGS).map(([ending, holds]) => [`.${ending}`, holds] as const);
const TABLES = ALL.flatMap(([ending, holds]) => (holds === "table" ? [ending] : []));
const FRAMES: Partial<Record<Holds, Omit<Format, "holds">>> = {
  ply: { frame: plyFrame, hasColumns: true, written: [".ply"] },
  pcd: { frame: pcdFrame, hasColumns: true, written: [".pcd"] },
  las: { frame: lasFrame, hasColumns: false, written: [".las"] },
  table: { frame: tableFrame, hasColumns: true, written: TABLES },
};

/** The formats that can be read, by the ending of a file's name. */
export const FORMATS: Record<string, Format> = Object.fromEntries(
  ALL.map(([ending, holds]) => [ending, { holds, hasColumns: false, written: [], ...FRAMES[holds] }]),
);

/** The ending that tells the format of a file. `.gz` stands behind it. */
export function endingOf(name: string): string {
  return extname(name.replace(/\.gz$/i, "")).toLowerCase();
}

/** The ending of an output with points, and whether they are copied there. Undefined: it holds no points of this file. */
export function writtenAs(input: string, output: string): { ending: string; isCopy: boolean } | undefined {
  const { written } = FORMATS[endingOf(input)]!;
  const ending = output === "-" ? (written[0] ?? CONVERTED[0]!) : extname(output).toLowerCase();
  const isCopy = written.includes(ending);
  return isCopy || CONVERTED.includes(ending) ? { ending, isCopy } : undefined;
}

const SAID: Readonly<Record<Holds, string>> = {
  ply: "PLY", pcd: "PCD", las: "LAS", e57: "E57", ptx: "PTX", obj: "OBJ", gltf: "glTF", table: "a table", array: "an array",
}; // prettier-ignore

/** Reads the files beside a glTF file. */
async function besideOf(name: string): Promise<Pick<Reading, "beside">> {
  const { beside, close } = await sourceOf(name, undefined);
  await close();
  return { beside };
}

/** Reads the points of a file, with the bytes of each. */
export async function readPoints(
  name: string,
  file: Buffer<ArrayBuffer>,
  { chosen, damaged }: Pick<Reading, "chosen" | "damaged">,
): Promise<PointFile> {
  const { holds, frame } = FORMATS[endingOf(name)]!;
  const source = bytesSource(file);
  const asked = { name, source, records: true, chosen, damaged, wasm: compileFiles };
  const cloud = await readFile({ ...asked, ...(holds === "gltf" && (await besideOf(name))) });
  if (cloud.format !== holds) {
    throw new FormatProblem(`it is ${SAID[cloud.format]}, and its name says ${SAID[holds]}; give it another ending`);
  }
  if (cloud.crs?.isAngular) throw new FormatProblem(DEGREES);
  const records = { ...cloud.records, bytes: cloud.records.bytes ?? file };
  return { ...cloud, ...frame?.(file, { ...cloud, records }, chosen), records };
}
