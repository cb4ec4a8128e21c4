import { type Column, bytesOf, type NumberReader, numberReader, type NumberType } from "../numbers.js";
import { FormatProblem } from "../problem.js";
import { type Source, viewOf } from "../source.js";
import {
  CLASSES,
  CLASSIFICATION,
  LAS_RECORD_HEADER,
  type LasHeader,
  type LasRecord,
  lasRecords,
  LONGEST_LAS_HEADER,
  readLasHeader,
  textAt,
  type FieldPlace,
  layoutOf,
} from "./header.js";
import { type Crs, crsOf, type CrsRecords } from "./crs.js";

/** A LAS header, the values of its points, and their coordinate system. */
export interface LasDetails extends LasHeader {
  columns: readonly LasColumn[];
  crs: Crs | null;
  las: LasSource;
  /** The bytes of the header and of the records after it. */
  head: DataView;
}

/** The parts of a LAS file that its points alone do not say. With them, the file can be written again. */
export interface LasSource {
  /** The header as it is in the file. */
  head: Uint8Array;
  format: number;
  scale: readonly [number, number, number];
  offset: readonly [number, number, number];
  /** The records before the points, such as the coordinate system, each with its own head of 54 bytes. */
  records: Uint8Array[];
  /** The descriptions of the extra columns, in the order of the file. */
  extras: { name: string; description: Uint8Array }[];
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
  "uint64",
  "int64",
  "float32",
  "float64",
];
const EXTRA_RECORD = 192;

export async function readLasDetails({ size, read }: Source): Promise<LasDetails> {
  const details = parseLasDetails(await read(0, LONGEST_LAS_HEADER));
  const { start, minor, head, crs, las } = details;
  if (start > size) throw new FormatProblem("its points would begin after its end");
  // Since version 1.4, records may also follow the points.
  const at = minor === 4 ? Number(head.getBigUint64(235, true)) : 0;
  if (crs || at === 0 || at >= size) return details;
  const end = viewOf(await read(at, at + LONGEST_LAS_HEADER));
  const { wkt } = crsRecords(end, lasRecords(end, 0, head.getUint32(243, true), "after"));
  if (wkt === undefined) return details;
  return { ...details, crs: crsOf({ wkt }), las: { ...las, records: [...las.records, wktRecord(wkt)] } };
}

/** The coordinate system as a record before the points. */
function wktRecord(wkt: string): Uint8Array {
  const head = LAS_RECORD_HEADER.before;
  const text = new TextEncoder().encode(`${wkt}\0`);
  const record = new Uint8Array(head + text.length);
  record.set(new TextEncoder().encode("LASF_Projection"), 2);
  new DataView(record.buffer).setUint16(18, 2112, true);
  new DataView(record.buffer).setUint16(20, text.length, true);
  record.set(text, head);
  return record;
}

export function parseLasDetails(data: Uint8Array): LasDetails {
  const frame = readLasHeader(data);
  const { format, rowBytes, records } = frame;
  const view = viewOf(data);
  const { places, bytes: least } = layoutOf(format)!;
  const extra = records.find(({ user, id }) => user === "LASF_Spec" && id === 4);
  return {
    ...frame,
    columns: [...places.map(columnOf), ...(extra ? extraColumns(view, extra, least, rowBytes) : [])],
    crs: crsOf(crsRecords(view, records)),
    head: view,
    las: {
      head: data.slice(0, Math.min(frame.headerBytes, 375)),
      format,
      scale: frame.scale,
      offset: frame.offset,
      records: records.filter(isKept).map(({ at, length }) => data.slice(at - LAS_RECORD_HEADER.before, at + length)),
      extras: extra ? descriptionsIn(data, extra) : [],
    },
  };
}

/** Records about the compression and the extra columns suit only the file that they are in. */
function isKept({ user, id }: LasRecord): boolean {
  return user !== "copc" && user !== "laszip encoded" && !(user === "LASF_Spec" && id === 4);
}

function descriptionsIn(data: Uint8Array, { at, length }: LasRecord): LasSource["extras"] {
  const view = new DataView(data.buffer, data.byteOffset);
  return Array.from({ length: Math.floor(length / EXTRA_RECORD) }, (_, i) => {
    const from = at + i * EXTRA_RECORD;
    const name = textAt(view, from + 4, 32).trim() || "extra";
    return { name, description: data.slice(from, from + EXTRA_RECORD) };
  });
}

function crsRecords(view: DataView, records: readonly LasRecord[]): CrsRecords {
  const found: CrsRecords = {};
  for (const { user, id, at, length } of records) {
    if (user !== "LASF_Projection") continue;
    if (id === 2112) found.wkt = textAt(view, at, length);
    if (id === 34_737) found.texts = textAt(view, at, length);
    if (id === 34_735) {
      found.keys = Uint16Array.from({ length: length >> 1 }, (_, i) => view.getUint16(at + 2 * i, true));
    }
  }
  return found;
}

function columnOf({ name, type, offset, bits, isDetail }: FieldPlace): LasColumn {
  const whole = numberReader(type, offset, true);
  const [first, count] = bits ?? [0, 0];
  const mask = (1 << count) - 1;
  const read: NumberReader = bits ? (view, at) => (view.getUint8(at + offset) >> first) & mask : whole;
  const labels = name === CLASSIFICATION && { labels: CLASSES };
  return { name, type, read, ...(isDetail && { isDetail }), ...labels };
}

/** The extra values of each point, as the program that added them describes them. */
function extraColumns(view: DataView, { at, length }: LasRecord, from: number, rowBytes: number): LasColumn[] {
  const columns: LasColumn[] = [];
  let offset = from;
  for (let record = at; record + EXTRA_RECORD <= at + length; record += EXTRA_RECORD) {
    const kind = view.getUint8(record + 2);
    const options = view.getUint8(record + 3);
    // Types from 11 on are two, and from 21 on three numbers of the types from 1 to 10. They are deprecated, but written.
    const type = EXTRA_TYPES[kind > 10 ? ((kind - 1) % 10) + 1 : kind];
    const numbers = kind > 20 ? 3 : kind > 10 ? 2 : 1;
    const size = kind === 0 ? options : type ? numbers * bytesOf(type) : 0;
    if (size === 0 || kind > 30 || offset + size > rowBytes) break;
    const name = textAt(view, record + 4, 32).trim() || "extra";
    for (let i = 0; type && i < numbers; i++) {
      const scale = options & 8 ? view.getFloat64(record + 112 + 8 * i, true) : 1;
      const shift = options & 16 ? view.getFloat64(record + 136 + 8 * i, true) : 0;
      const read = numberReader(type, offset + i * bytesOf(type), true);
      const called = numbers > 1 ? `${name} ${i + 1}` : name;
      const plain = scale === 1 && shift === 0;
      columns.push(
        plain
          ? { name: called, type, read }
          : { name: called, type: "float64", read: (row, place) => read(row, place) * scale + shift },
      );
    }
    offset += size;
  }
  return columns;
}
