import type { Column } from "../builder.ts";
import { bytes } from "../blocks.ts";
import { bytesOf, type NumberReader, numberReader, type NumberType } from "../../../src/ts/formats/numbers.js";
import { LoadProblem } from "../problem.ts";
import type { Crs } from "../../cloud/facts.ts";
import { crsOf, type CrsRecords } from "./crs.ts";
import { type FieldPlace, layoutOf } from "./places.ts";

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
  crs: Crs | null;
}

export interface LasColumn extends Column {
  read: NumberReader;
}

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
  return header.crs ? header : { ...header, crs: await crsAtEnd(name, blob, data) };
}

/** Since version 1.4, records may also follow the points. */
async function crsAtEnd(name: string, blob: Blob, head: ArrayBuffer): Promise<Crs | null> {
  const view = new DataView(head);
  if (view.getUint8(25) !== 4) return null;
  const at = Number(view.getBigUint64(235, true));
  if (at === 0 || at >= blob.size) return null;
  const end = new DataView(await bytes(name, blob, at, at + LONGEST_HEADER));
  return crsOf(crsRecords(end, recordsOf(end, 0, view.getUint32(243, true), 60)));
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
  const layout = layoutOf(format);
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
    columns: [...layout.places.map(columnOf), ...(extra ? extraColumns(view, extra, layout.bytes, rowBytes) : [])],
    crs: crsOf(crsRecords(view, records)),
  };
}

interface VariableRecord {
  user: string;
  id: number;
  at: number;
  length: number;
}

/**
 * The records between the header and the points, or behind the points. Records that do not fit there are left out.
 * `head`: the bytes before the content of a record.
 */
function recordsOf(view: DataView, start: number, count: number, head: 54 | 60 = 54): VariableRecord[] {
  const records: VariableRecord[] = [];
  for (let at = start, i = 0; i < count && at + head <= view.byteLength; i++) {
    const length = head === 54 ? view.getUint16(at + 20, true) : Number(view.getBigUint64(at + 20, true));
    if (at + head + length > view.byteLength) break;
    records.push({ user: textAt(view, at + 2, 16), id: view.getUint16(at + 18, true), at: at + head, length });
    at += head + length;
  }
  return records;
}

function crsRecords(view: DataView, records: readonly VariableRecord[]): CrsRecords {
  const found: CrsRecords = {};
  for (const { user, id, at, length } of records) {
    if (user !== "LASF_Projection") continue;
    if (id === 2112) found.wkt = textAt(view, at, length);
    if (id === 34_737) found.texts = textAt(view, at, length);
    if (id === 34_735)
      found.keys = Uint16Array.from({ length: length >> 1 }, (_, i) => view.getUint16(at + 2 * i, true));
  }
  return found;
}

function textAt(view: DataView, at: number, length: number): string {
  return new TextDecoder("latin1").decode(new Uint8Array(view.buffer, at, length)).replace(/\0[\s\S]*$/, "");
}

function columnOf({ name, type, offset, bits, isDetail }: FieldPlace): LasColumn {
  const whole = numberReader(type, offset, true);
  const [first, count] = bits ?? [0, 0];
  const mask = (1 << count) - 1;
  const read: NumberReader = bits ? (view, at) => (view.getUint8(at + offset) >> first) & mask : whole;
  return { name, type, read, ...(isDetail && { isDetail }) };
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
        plain ? { name, type, read } : { name, type: "float64", read: (row, i) => read(row, i) * scale + shift },
      );
    }
    offset += size;
  }
  return columns;
}
