import { FormatProblem } from "../problem.js";
import type { NumberType } from "../numbers.js";
import { byteText } from "../text.js";

/**
 * The parts of a LAS header for the versions 1.0 to 1.4 (ASPRS, LAS Specification 1.4 R15). The copc package also has
 * a parser, but only for 1.2 and 1.4, and not for all point formats.
 */
export interface LasHeader {
  count: number;
  compressed: boolean;
  /** Whether the LAZ file is also an octree. */
  isCopc: boolean;
  /** The second number of the version. */
  minor: number;
  format: number;
  rowBytes: number;
  /** The length of the fixed part. */
  headerBytes: number;
  /** The place of the first point. */
  start: number;
  /** A coordinate is its integer times the scale, plus the offset. */
  scale: readonly [number, number, number];
  offset: readonly [number, number, number];
  low: readonly [number, number, number];
  high: readonly [number, number, number];
  /** The records between the header and the points. */
  records: readonly LasRecord[];
}

/** A record between the header and the points, or after the points. */
export interface LasRecord {
  user: string;
  id: number;
  /** The place and the length of its contents. Its own header is before them. */
  at: number;
  length: number;
}

/** The least number of bytes of a point, for each format from 0 to 10. Files may add values of their own. */
export const LAS_POINT_BYTES: readonly number[] = [20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67];

/** The length of the header of a record, before and after the points. */
export const LAS_RECORD_HEADER = { before: 54, after: 60 } as const;

/** The number of bytes at the start of a file in which the header is looked for. */
export const LONGEST_LAS_HEADER = 1 << 20;
const SHORTEST = 227;

/** @param data the file's bytes, or the first LONGEST_LAS_HEADER of them */
export function readLasHeader(data: Uint8Array): LasHeader {
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  if (textAt(view, 0, Math.min(4, view.byteLength)) !== "LASF") {
    throw new FormatProblem("it does not begin like a LAS file");
  }
  if (view.byteLength < SHORTEST) throw new FormatProblem("it ends within its LAS header");
  const [major, minor] = [view.getUint8(24), view.getUint8(25)];
  if (major !== 1 || minor > 4) {
    throw new FormatProblem(`its LAS version is ${major}.${minor}, and only 1.0 to 1.4 can be read`);
  }
  const headerBytes = view.getUint16(94, true);
  const start = view.getUint32(96, true);
  if (headerBytes < SHORTEST || start < headerBytes || (minor === 4 && view.byteLength < 375)) {
    throw new FormatProblem("the sizes in its LAS header are impossible");
  }

  // The two upper bits of the format are set if the points are compressed.
  const format = view.getUint8(104) & 63;
  const compressed = view.getUint8(104) >> 6 !== 0;
  const least = LAS_POINT_BYTES[format];
  const rowBytes = view.getUint16(105, true);
  if (least === undefined) throw new FormatProblem(`its LAS points have an unknown format (${format})`);
  if (rowBytes < least) throw new FormatProblem("its LAS points are shorter than their format");

  const vector = (at: number, step = 8) =>
    [0, 1, 2].map((axis) => view.getFloat64(at + axis * step, true)) as [number, number, number];
  const scale = vector(131);
  const offset = vector(155);
  if (![...scale, ...offset].every(Number.isFinite) || scale.includes(0)) {
    throw new FormatProblem("its LAS header has no usable scale and offset");
  }
  const records = lasRecords(view, headerBytes, view.getUint32(100, true));
  const count =
    minor === 4 ? Number(view.getBigUint64(247, true)) || view.getUint32(107, true) : view.getUint32(107, true);
  return {
    count,
    compressed,
    isCopc: records.some(({ user, id }) => user === "copc" && id === 1),
    minor,
    format,
    rowBytes,
    headerBytes,
    start,
    scale,
    offset,
    low: vector(187, 16),
    high: vector(179, 16),
    records,
  };
}

/** The records from a place on. Records that do not fit there are left out. */
export function lasRecords(
  view: DataView,
  start: number,
  count: number,
  place: keyof typeof LAS_RECORD_HEADER = "before",
): LasRecord[] {
  const head = LAS_RECORD_HEADER[place];
  const records: LasRecord[] = [];
  for (let at = start, i = 0; i < count && at + head <= view.byteLength; i++) {
    const length = place === "before" ? view.getUint16(at + 20, true) : Number(view.getBigUint64(at + 20, true));
    if (at + head + length > view.byteLength) break;
    records.push({ user: textAt(view, at + 2, 16), id: view.getUint16(at + 18, true), at: at + head, length });
    at += head + length;
  }
  return records;
}

export function textAt(view: DataView, at: number, length: number): string {
  return byteText(new Uint8Array(view.buffer, view.byteOffset + at, length)).replace(/\0[\s\S]*$/, "");
}

/** Reads a point's position. The integers keep all digits, and so do doubles: UTM coordinates lose nothing. */
export function lasPosition({ scale, offset }: LasHeader, view: DataView, at: number): [number, number, number] {
  return [
    view.getInt32(at, true) * scale[0] + offset[0],
    view.getInt32(at + 4, true) * scale[1] + offset[1],
    view.getInt32(at + 8, true) * scale[2] + offset[2],
  ];
}

/** The classes of the LAS specification (1.4 R15, table 17). */
export const CLASSES: Readonly<Record<number, string>> = {
  0: "never classified", 1: "unclassified", 2: "ground", 3: "low vegetation", 4: "medium vegetation", 5: "high vegetation",
  6: "building", 7: "low noise", 8: "key point", 9: "water", 10: "rail", 11: "road", 12: "overlap", 13: "wire guard",
  14: "wire", 15: "transmission tower", 16: "wire connector", 17: "bridge deck", 18: "high noise", 19: "overhead structure",
  20: "ignored ground", 21: "snow", 22: "temporal exclusion",
}; // prettier-ignore

/** The name of the column with a point's class. */
export const CLASSIFICATION = "classification";

/** Where a point's number is in its record. The reader and the writer of LAS take it from the same table. */
export interface FieldPlace {
  name: string;
  type: NumberType;
  offset: number;
  /** The bits of a byte that belong to it, from the lowest one on. Without them, it has its own bytes. */
  bits?: readonly [first: number, count: number];
  /** Nobody colors points by it. */
  isDetail?: true;
}

export interface PointLayout {
  bytes: number;
  places: readonly FieldPlace[];
}

/** For each point format (ASPRS, LAS Specification 1.4 R15): the places of its color and its time. */
const FORMATS: Record<number, { color?: number; time?: number; infrared?: number }> = {
  0: {},
  1: { time: 20 },
  2: { color: 20 },
  3: { time: 20, color: 28 },
  4: { time: 20 },
  5: { time: 20, color: 28 },
  6: { time: 22 },
  7: { time: 22, color: 30 },
  8: { time: 22, color: 30, infrared: 36 },
  9: { time: 22 },
  10: { time: 22, color: 30, infrared: 36 },
};

/** Where the numbers of a point format are, besides x, y and z. `null`: there is no such format. */
export function layoutOf(format: number): PointLayout | null {
  const layout = FORMATS[format];
  if (!layout) return null;
  const { color, time, infrared } = layout;
  const own = (name: string, type: NumberType, offset: number): FieldPlace => ({ name, type, offset });
  const shared = (name: string, offset: number, first: number, count: number): FieldPlace => ({
    name,
    type: "uint8",
    offset,
    bits: [first, count],
  });
  const detail = (place: FieldPlace): FieldPlace => ({ ...place, isDetail: true });
  const isNew = format >= 6;
  return {
    bytes: LAS_POINT_BYTES[format]!,
    places: [
      ...(color === undefined
        ? []
        : ["red", "green", "blue"].map((channel, i) => own(channel, "uint16", color + 2 * i))),
      own("intensity", "uint16", 12),
      isNew ? own("classification", "uint8", 16) : shared("classification", 15, 0, 5),
      shared("return number", 14, 0, isNew ? 4 : 3),
      own("point source", "uint16", isNew ? 20 : 18),
      ...(time === undefined ? [] : [own("time", "float64", time)]),
      ...(infrared === undefined ? [] : [own("near infrared", "uint16", infrared)]),
      detail(isNew ? shared("number of returns", 14, 4, 4) : shared("number of returns", 14, 3, 3)),
      detail(isNew ? own("scan angle", "int16", 18) : own("scan angle", "int8", 16)),
      detail(own("user data", "uint8", 17)),
      detail(isNew ? shared("class flags", 15, 0, 4) : shared("class flags", 15, 5, 3)),
      ...(isNew ? [detail(shared("scanner channel", 15, 4, 2))] : []),
      detail(shared("scan direction", isNew ? 15 : 14, 6, 1)),
      detail(shared("edge of flight line", isNew ? 15 : 14, 7, 1)),
    ],
  };
}
