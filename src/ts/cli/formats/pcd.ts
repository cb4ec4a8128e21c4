import { type NumberType, reader, roomFor, sizeOf, viewOf } from "./binary.js";
import { LinePoints, linesOf } from "./lines.js";
import { unpackLzf } from "./lzf.js";
import { equalRecords, FileProblem, type PointFile } from "./point-file.js";

interface Field {
  name: string;
  type: NumberType;
  count: number;
}

interface PcdHeader {
  fields: Field[];
  points: number;
  data: "ascii" | "binary" | "binary_compressed";
  /** Its lines with their ends. */
  lines: string[];
  end: number;
}

const KINDS: Record<string, string> = { F: "Float", I: "Int", U: "Uint" };
const TYPES: NumberType[] = [
  "Int8",
  "Uint8",
  "Int16",
  "Uint16",
  "Int32",
  "Uint32",
  "BigInt64",
  "BigUint64",
  "Float32",
  "Float64",
];

/** PCD, in text, binary and compressed; what was compressed is written as plain binary. */
export function readPcd(file: Buffer): PointFile {
  const header = readHeader(file);
  const places = ["x", "y", "z"].map((axis) => header.fields.findIndex(({ name }) => name === axis));
  if (places.includes(-1)) throw new FileProblem("its PCD header names no x, y and z");
  const read = header.data === "ascii" ? readText : readBinary;
  return {
    ...read(file, header, places),
    leftOut: [],
    header: (count) => Buffer.from(headerOf(header, count), "latin1"),
  };
}

function readHeader(file: Buffer): PcdHeader {
  const found = new Map<string, string[]>();
  const lines: string[] = [];
  for (const { text, start, end } of linesOf(file)) {
    const [keyword = "", ...words] = text.split(/\s+/);
    lines.push(file.toString("latin1", start, end));
    found.set(keyword.toUpperCase(), words);
    if (keyword.toUpperCase() !== "DATA") continue;
    const data = words[0]?.toLowerCase();
    if (data !== "ascii" && data !== "binary" && data !== "binary_compressed") {
      throw new FileProblem("its PCD data is none of ascii, binary and binary_compressed");
    }
    return { fields: fieldsOf(found), points: pointsOf(found), data, lines, end };
  }
  throw new FileProblem("its PCD header has no end");
}

function fieldsOf(header: Map<string, string[]>): Field[] {
  const [types, sizes, counts] = ["TYPE", "SIZE", "COUNT"].map((keyword) => header.get(keyword));
  return (header.get("FIELDS") ?? []).map((name, i) => {
    const written = `${KINDS[types?.[i]?.toUpperCase() ?? ""] ?? "?"}${8 * Number(sizes?.[i])}`;
    const type = TYPES.find((one) => one === written || one === `Big${written}`);
    const count = counts === undefined ? 1 : Number(counts[i]);
    if (type === undefined || !Number.isInteger(count) || count < 1)
      throw new FileProblem(`its PCD header does not say what ${name} is`);
    return { name, type, count };
  });
}

function pointsOf(header: Map<string, string[]>): number {
  const [points, width, height] = ["POINTS", "WIDTH", "HEIGHT"].map((keyword) => header.get(keyword)?.[0]);
  const count = points === undefined ? Number(width) * Number(height ?? 1) : Number(points);
  if (!Number.isSafeInteger(count) || count < 0)
    throw new FileProblem("its PCD header does not say how many points there are");
  return count;
}

function headerOf({ lines, data }: PcdHeader, count: number): string {
  const values: Record<string, string> = {
    WIDTH: String(count),
    HEIGHT: "1",
    POINTS: String(count),
    DATA: data === "ascii" ? "ascii" : "binary",
  };
  return lines
    .map((line) =>
      line.replace(/^(\s*)(\w+)(\s+)\S+/, (same, indent, keyword: string, space) => {
        const value = values[keyword.toUpperCase()];
        return value === undefined ? same : `${indent}${keyword}${space}${value}`;
      }),
    )
    .join("");
}

type Points = Pick<PointFile, "positions" | "records">;

function readText(file: Buffer, { fields, points: count, lines, end }: PcdHeader, places: number[]): Points {
  const columns = places.map((place) => fields.slice(0, place).reduce((sum, field) => sum + field.count, 0));
  const points = new LinePoints(file);
  for (const line of linesOf(file, end, lines.length + 1)) {
    if (points.count === count) break;
    if (line.text === "") continue;
    const words = line.text.split(/\s+/);
    points.add(
      line,
      columns.map((column) => words[column]),
    );
  }
  if (points.count < count) throw endsEarly(points.count, count);
  const positions = roomFor(
    count,
    places.map((place) => fields[place]!.type),
  );
  positions.set(points.numbers);
  return { positions, records: points.records };
}

function readBinary(file: Buffer, header: PcdHeader, places: number[]): Points {
  const { fields, points: count } = header;
  const size = bytesOf(fields);
  const body = header.data === "binary" ? file.subarray(header.end) : interleaved(file.subarray(header.end), header);
  if (body.length < size * count) throw endsEarly(Math.floor(body.length / size), count);
  const view = viewOf(body);
  const types = places.map((place) => fields[place]!.type);
  const readers = types.map((type) => reader(view, type, true));
  const offsets = places.map((place) => bytesOf(fields.slice(0, place)));
  const positions = roomFor(count, types);
  for (let i = 0; i < count; i++) {
    for (let axis = 0; axis < 3; axis++) positions[3 * i + axis] = readers[axis]!(i * size + offsets[axis]!);
  }
  return { positions, records: equalRecords(body, 0, size) };
}

/** Compressed files hold all values of one field before those of the next. */
function interleaved(body: Buffer, { fields, points: count }: PcdHeader): Uint8Array {
  const size = bytesOf(fields);
  if (body.length < 8) throw endsEarly(0, count);
  const [packed, unpacked] = [body.readUInt32LE(0), body.readUInt32LE(4)];
  if (unpacked !== size * count) throw new FileProblem("its compressed data is not as long as its header promises");
  if (packed > body.length - 8) throw endsEarly(0, count);
  const columns = unpackLzf(body.subarray(8, 8 + packed), unpacked);
  const records = new Uint8Array(unpacked);
  let [from, offset] = [0, 0];
  for (const field of fields) {
    const width = bytesOf([field]);
    for (let i = 0; i < count; i++, from += width) {
      for (let byte = 0; byte < width; byte++) records[i * size + offset + byte] = columns[from + byte]!;
    }
    offset += width;
  }
  return records;
}

function bytesOf(fields: Field[]): number {
  return fields.reduce((sum, { type, count }) => sum + count * sizeOf(type), 0);
}

function endsEarly(found: number, count: number): FileProblem {
  return new FileProblem(`it ends after ${found} of the ${count} points that its header promises`);
}
