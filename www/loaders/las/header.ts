import type { Column } from "../builder.ts";
import { bytes } from "../blocks.ts";
import { bytesOf, type NumberReader, numberReader, type NumberType } from "../../../src/ts/formats/numbers.js";
import {
  type LasHeader as LasFrame,
  type LasRecord,
  lasRecords,
  LONGEST_LAS_HEADER,
  readLasHeader,
  textAt,
} from "../../../src/ts/formats/las.js";
import { LoadProblem } from "../problem.ts";
import type { Crs } from "../../cloud/facts.ts";
import { crsOf, type CrsRecords } from "./crs.ts";
import { type FieldPlace, layoutOf } from "./places.ts";

/** A LAS header, the values of its points, and their coordinate system. */
export interface LasHeader extends LasFrame {
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

export async function readHeader(name: string, blob: Blob): Promise<LasHeader> {
  const data = new Uint8Array(await bytes(name, blob, 0, LONGEST_LAS_HEADER));
  const header = parseHeader(data);
  if (header.start > blob.size) throw new LoadProblem(`${name} is broken: its points would begin after its end.`);
  return header.crs ? header : { ...header, crs: await crsAtEnd(name, blob, data) };
}

/** Since version 1.4, records may also follow the points. */
async function crsAtEnd(name: string, blob: Blob, head: Uint8Array): Promise<Crs | null> {
  const view = new DataView(head.buffer);
  if (view.getUint8(25) !== 4) return null;
  const at = Number(view.getBigUint64(235, true));
  if (at === 0 || at >= blob.size) return null;
  const end = new DataView(await bytes(name, blob, at, at + LONGEST_LAS_HEADER));
  return crsOf(crsRecords(end, lasRecords(end, 0, view.getUint32(243, true), "after")));
}

export function parseHeader(data: Uint8Array): LasHeader {
  const frame = readLasHeader(data);
  const { format, rowBytes, records } = frame;
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  const { places, bytes: least } = layoutOf(format)!;
  const extra = records.find(({ user, id }) => user === "LASF_Spec" && id === 4);
  return {
    ...frame,
    columns: [...places.map(columnOf), ...(extra ? extraColumns(view, extra, least, rowBytes) : [])],
    crs: crsOf(crsRecords(view, records)),
  };
}

function crsRecords(view: DataView, records: readonly LasRecord[]): CrsRecords {
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

function columnOf({ name, type, offset, bits, isDetail }: FieldPlace): LasColumn {
  const whole = numberReader(type, offset, true);
  const [first, count] = bits ?? [0, 0];
  const mask = (1 << count) - 1;
  const read: NumberReader = bits ? (view, at) => (view.getUint8(at + offset) >> first) & mask : whole;
  return { name, type, read, ...(isDetail && { isDetail }) };
}

/** The extra values of each point, as the program that added them describes them. */
function extraColumns(view: DataView, { at, length }: LasRecord, from: number, rowBytes: number): LasColumn[] {
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
