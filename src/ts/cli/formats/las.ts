// LAS, LAZ and COPC. All are written as LAS.
import type { CloudFile } from "../../formats/cloud-file.js";
import {
  LAS_RECORD_HEADER,
  type LasHeader,
  lasPosition,
  lasRecords,
  LONGEST_LAS_HEADER,
  readLasHeader,
} from "../../formats/las/header.js";
import { viewOf } from "../../formats/source.js";
import type { Frame } from "./frames.js";

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
