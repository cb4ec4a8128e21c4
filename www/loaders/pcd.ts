import type { LoadedCloud } from "../cloud/cloud.ts";
import { bytes, type Reading } from "./blocks.ts";
import { CloudBuilder } from "./builder.ts";
import { checkByteLength } from "./limits.ts";
import { unpackLzf } from "./lzf.ts";
import { bytesOf, type NumberReader, numberReader, type NumberType } from "./numbers.ts";
import { LoadProblem } from "./problem.ts";
import { endsEarly, type Field, readBinaryRows, readTextRows, type Rows } from "./rows.ts";

const LONGEST_HEADER = 1 << 16;

interface PcdHeader {
  kind: "ascii" | "binary" | "binary_compressed";
  rows: Rows;
  rowBytes: number;
  entries: ReadonlyMap<string, string[]>;
}

export async function readPcd(reading: Reading): Promise<LoadedCloud> {
  const { name, blob } = reading;
  const header = headerOf(name, await bytes(name, blob, 0, LONGEST_HEADER));
  const cloud =
    header.kind === "ascii"
      ? await readTextRows(reading, header.rows)
      : header.kind === "binary"
        ? await readBinaryRows(reading, header.rows, header.rowBytes)
        : await readCompressed(reading, header);
  return { ...cloud, ...packedColors(cloud), ...taken(header.entries) };
}

function headerOf(name: string, data: ArrayBuffer): PcdHeader {
  const broken = (why: string) => new LoadProblem(`${name} is broken: ${why}.`);
  // Latin-1 keeps one character a byte, so that a position in the text is a position in the file.
  const match = /^([\s\S]*?(?:^|[\r\n])DATA[ \t]+(\w+)[ \t]*)(\r\n|\r|\n|$)/i.exec(
    new TextDecoder("latin1").decode(data),
  );
  if (!match) throw broken("its PCD header has no end");
  const kind = match[2]!.toLowerCase();
  if (kind !== "ascii" && kind !== "binary" && kind !== "binary_compressed") {
    throw new LoadProblem(`${name} is a PCD file of an unknown kind (${match[2]}).`);
  }

  const entries = new Map<string, string[]>();
  for (const line of match[1]!.split(/[\r\n]+/)) {
    const words = line.trim().split(/\s+/);
    if (words[0] && !words[0].startsWith("#")) entries.set(words[0].toUpperCase(), words.slice(1));
  }
  const names = entries.get("FIELDS") ?? entries.get("COLUMNS") ?? [];
  const sizes = (entries.get("SIZE") ?? []).map(Number);
  const types = entries.get("TYPE") ?? [];
  const counts = entries.has("COUNT") ? entries.get("COUNT")!.map(Number) : names.map(() => 1);
  const count = entries.has("POINTS")
    ? Number(entries.get("POINTS")![0])
    : Number(entries.get("WIDTH")?.[0]) * Number(entries.get("HEIGHT")?.[0]);
  if (!["x", "y", "z"].every((axis) => names.includes(axis))) throw broken("its PCD header names no x, y and z");
  if ([sizes, types, counts].some((line) => line.length !== names.length))
    throw broken("the lines of its PCD header do not match");
  if (!Number.isSafeInteger(count) || count < 0) throw broken("its PCD header does not say how many points there are");
  if (![...sizes, ...counts].every((value) => Number.isInteger(value) && value >= 0))
    throw broken("a size in its PCD header is not a number");

  const fields: Field[] = [];
  let [offset, word] = [0, 0];
  names.forEach((field, i) => {
    const isColor = /^rgba?$/.test(field);
    // Four bytes of color may call themselves a float, which would lose them where they are none.
    const type = isColor && kind !== "ascii" && sizes[i] === 4 ? "uint32" : typeOf(types[i]!, sizes[i]!);
    // Fields of several numbers are descriptors, histograms, padding.
    if (type && counts[i] === 1) fields.push({ name: field, type, offset, word });
    offset += sizes[i]! * counts[i]!;
    word += counts[i]!;
  });
  const position = ["x", "y", "z"].map((axis) => fields.find((field) => field.name === axis));
  if (position.includes(undefined)) throw broken("the x, y and z of its PCD header are no numbers");
  const others = fields
    .filter((field) => !position.includes(field))
    .sort((a, b) => Number(/^rgba?$/.test(b.name)) - Number(/^rgba?$/.test(a.name)));
  const rows = { start: match[0].length, count, position: position as [Field, Field, Field], others };
  return { kind, rows, rowBytes: offset, entries };
}

function typeOf(letter: string, size: number): NumberType | null {
  const type = `${{ F: "float", U: "uint", I: "int" }[letter] ?? ""}${8 * size}`;
  return /^(float(32|64)|u?int(8|16|32))$/.test(type) ? (type as NumberType) : null;
}

/** Compressed files go field by field: all x, all y, all z. */
async function readCompressed({ name, blob, limit }: Reading, { rows, rowBytes }: PcdHeader): Promise<LoadedCloud> {
  const { start, count, position, others } = rows;
  checkByteLength(name, blob.size);
  const data = await bytes(name, blob, start, blob.size);
  if (data.byteLength < 8) throw endsEarly(name, count);
  const sizes = new DataView(data, 0, 8);
  const [packed, plain] = [sizes.getUint32(0, true), sizes.getUint32(4, true)];
  if (packed > data.byteLength - 8 || plain < count * rowBytes) throw endsEarly(name, count);
  checkByteLength(name, plain);
  const unpacked = unpackLzf(new Uint8Array(data, 8, packed), plain);
  if (!unpacked) throw new LoadProblem(`${name} is broken: its compressed points cannot be unpacked.`);

  const view = new DataView(unpacked.buffer);
  const reader = ({ type, offset }: Field): NumberReader => numberReader(type, offset * count, true);
  const [x, y, z] = position.map(reader) as [NumberReader, NumberReader, NumberReader];
  const readers = others.map((field) => ({ read: reader(field), bytes: bytesOf(field.type) }));
  const strides = position.map(({ type }) => bytesOf(type)) as [number, number, number];
  const single = position.every(({ type }) => type === "float32");
  const builder = new CloudBuilder(single ? "float32" : "float64", others, limit, count);
  for (let row = 0; row < count; row++) {
    if (!builder.takes()) continue;
    const i = builder.put(x(view, row * strides[0]), y(view, row * strides[1]), z(view, row * strides[2]));
    for (let k = 0; k < readers.length; k++) builder.values[k]![i] = readers[k]!.read(view, row * readers[k]!.bytes);
  }
  return builder.finish();
}

/** A color is four bytes in one number; a text may write that as the float of the same bytes. */
function packedColors({ colors, attributes = [] }: LoadedCloud): Pick<LoadedCloud, "colors" | "attributes"> {
  const packed = attributes.find(({ name }) => name === "rgb" || name === "rgba");
  if (!packed) return { colors, attributes };
  const { values } = packed;
  const bits = values instanceof Float32Array ? new Uint32Array(values.buffer) : values;
  const bytes = new Uint8Array(3 * bits.length);
  for (let i = 0; i < bits.length; i++) {
    bytes[3 * i] = (bits[i]! >>> 16) & 255;
    bytes[3 * i + 1] = (bits[i]! >>> 8) & 255;
    bytes[3 * i + 2] = bits[i]! & 255;
  }
  return { colors: bytes, attributes: attributes.filter((attribute) => attribute !== packed) };
}

/** Rows and columns as a depth camera sees them: in its own coordinates, x to the right, y down, z ahead. */
function taken(entries: ReadonlyMap<string, string[]>): Pick<LoadedCloud, "taken"> {
  if (!(Number(entries.get("HEIGHT")?.[0]) > 1)) return {};
  const [x, y, z] = (entries.get("VIEWPOINT") ?? []).map(Number);
  return { taken: { up: "-y", from: [x, y, z].every(Number.isFinite) ? [x!, y!, z!] : [0, 0, 0] } };
}
