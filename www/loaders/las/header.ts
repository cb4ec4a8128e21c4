import type { Column } from "../builder.ts";
import { bytes } from "../blocks.ts";
import { bytesOf, type NumberReader, numberReader, type NumberType } from "../../../src/ts/formats/numbers.js";
import { LoadProblem } from "../problem.ts";

/**
 * The parts of a LAS header that the page needs, for the versions 1.0 to 1.4 (ASPRS, LAS Specification 1.4 R15). The
 * copc package also has a parser, but only for 1.2 and 1.4, and not for all point formats.
 */
export interface LasHeader {
  count: number;
  compressed: boolean;
  /** Whether the LAZ file is also an octree. */
  isCopc: boolean;
  format: number;
  rowBytes: number;
  start: number;
  /** A coordinate is its integer times the scale, plus the offset. */
  scale: readonly [number, number, number];
  offset: readonly [number, number, number];
  low: readonly [number, number, number];
  high: readonly [number, number, number];
  columns: readonly LasColumn[];
}

export interface LasColumn extends Column {
  read: NumberReader;
}

/** For each point format: its length, and the places of its color and its time. */
const FORMATS: Record<number, { bytes: number; color?: number; time?: number }> = {
  0: { bytes: 20 },
  1: { bytes: 28, time: 20 },
  2: { bytes: 26, color: 20 },
  3: { bytes: 34, time: 20, color: 28 },
  4: { bytes: 57, time: 20 },
  5: { bytes: 63, time: 20, color: 28 },
  6: { bytes: 30, time: 22 },
  7: { bytes: 36, time: 22, color: 30 },
  8: { bytes: 38, time: 22, color: 30 },
  9: { bytes: 59, time: 22 },
  10: { bytes: 67, time: 22, color: 30 },
};
const EXTRA_TYPES: (NumberType | null)[] = [
  null,
  "uint8",
  "int8",
  "uint16",
  "int16",
  "uint32",
  "int32",
  null,
  null,
  "float32",
  "float64",
];
const EXTRA_RECORD = 192;
const LONGEST_HEADER = 1 << 20;

export async function readHeader(name: string, blob: Blob): Promise<LasHeader> {
  const data = await bytes(name, blob, 0, LONGEST_HEADER);
  const header = parseHeader(name, data);
  if (header.start > blob.size) throw new LoadProblem(`${name} is broken: its points would begin after its end.`);
  return header;
}

export function parseHeader(name: string, data: ArrayBuffer): LasHeader {
  const broken = (why: string) => new LoadProblem(`${name} is broken: ${why}.`);
  const view = new DataView(data);
  if (view.byteLength < 227) throw broken("it ends within its LAS header");
  const [major, minor] = [view.getUint8(24), view.getUint8(25)];
  if (major !== 1 || minor > 4)
    throw new LoadProblem(`${name} has LAS version ${major}.${minor}, but this page reads 1.0 to 1.4.`);
  const headerBytes = view.getUint16(94, true);
  const start = view.getUint32(96, true);
  if (headerBytes < 227 || start < headerBytes || (minor === 4 && view.byteLength < 375))
    throw broken("the sizes in its LAS header are impossible");

  // The two upper bits of the format are set if the points are compressed.
  const format = view.getUint8(104) & 63;
  const compressed = view.getUint8(104) >> 6 !== 0;
  const layout = FORMATS[format];
  const rowBytes = view.getUint16(105, true);
  if (!layout) throw new LoadProblem(`${name} has LAS points of an unknown format (${format}).`);
  if (rowBytes < layout.bytes) throw broken("its points are shorter than their format");

  const vector = (at: number, step = 8) =>
    [0, 1, 2].map((axis) => view.getFloat64(at + axis * step, true)) as [number, number, number];
  const scale = vector(131);
  const offset = vector(155);
  if (![...scale, ...offset].every(Number.isFinite) || scale.includes(0))
    throw broken("its LAS header has no usable scale and offset");
  const records = recordsOf(view, headerBytes, view.getUint32(100, true));
  const extra = records.find(({ user, id }) => user === "LASF_Spec" && id === 4);
  const count =
    minor === 4 ? Number(view.getBigUint64(247, true)) || view.getUint32(107, true) : view.getUint32(107, true);
  return {
    count,
    compressed,
    isCopc: records.some(({ user, id }) => user === "copc" && id === 1),
    format,
    rowBytes,
    start,
    scale,
    offset,
    low: vector(187, 16),
    high: vector(179, 16),
    columns: [...pointColumns(format, layout), ...(extra ? extraColumns(view, extra, layout.bytes, rowBytes) : [])],
  };
}

interface VariableRecord {
  user: string;
  id: number;
  at: number;
  length: number;
}

/** The records between the header and the points. Records that do not fit there are left out. */
function recordsOf(view: DataView, start: number, count: number): VariableRecord[] {
  const records: VariableRecord[] = [];
  for (let at = start, i = 0; i < count && at + 54 <= view.byteLength; i++) {
    const length = view.getUint16(at + 20, true);
    if (at + 54 + length > view.byteLength) break;
    records.push({ user: textAt(view, at + 2, 16), id: view.getUint16(at + 18, true), at: at + 54, length });
    at += 54 + length;
  }
  return records;
}

function textAt(view: DataView, at: number, length: number): string {
  return new TextDecoder("latin1").decode(new Uint8Array(view.buffer, at, length)).replace(/\0[\s\S]*$/, "");
}

function pointColumns(format: number, { color, time }: { color?: number; time?: number }): LasColumn[] {
  const plain = (name: string, type: NumberType, offset: number): LasColumn => ({
    name,
    type,
    read: numberReader(type, offset, true),
  });
  const newer = format >= 6;
  const masked = (name: string, offset: number, mask: number): LasColumn => ({
    name,
    type: "uint8",
    read: (view, at) => view.getUint8(at + offset) & mask,
  });
  return [
    ...(color === undefined
      ? []
      : ["red", "green", "blue"].map((channel, i) => plain(channel, "uint16", color + 2 * i))),
    plain("intensity", "uint16", 12),
    newer ? plain("classification", "uint8", 16) : masked("classification", 15, 31),
    masked("return number", 14, newer ? 15 : 7),
    plain("point source", "uint16", newer ? 20 : 18),
    ...(time === undefined ? [] : [plain("time", "float64", time)]),
  ];
}

/** The extra values of each point, as the program that added them describes them. */
function extraColumns(view: DataView, { at, length }: VariableRecord, from: number, rowBytes: number): LasColumn[] {
  const columns: LasColumn[] = [];
  let offset = from;
  for (let record = at; record + EXTRA_RECORD <= at + length; record += EXTRA_RECORD) {
    const kind = view.getUint8(record + 2);
    const options = view.getUint8(record + 3);
    const type = EXTRA_TYPES[kind];
    const size = kind === 0 ? options : type ? bytesOf(type) : kind <= 8 ? 8 : 0;
    // Types of several numbers are deprecated, and the place of the next field is unknown then.
    if (size === 0 || offset + size > rowBytes) break;
    if (type) {
      const scale = options & 8 ? view.getFloat64(record + 112, true) : 1;
      const shift = options & 16 ? view.getFloat64(record + 136, true) : 0;
      const read = numberReader(type, offset, true);
      const name = textAt(view, record + 4, 32).trim() || "extra";
      const plain = scale === 1 && shift === 0;
      columns.push(
        plain ? { name, type, read } : { name, type: "float32", read: (row, i) => read(row, i) * scale + shift },
      );
    }
    offset += size;
  }
  return columns;
}
