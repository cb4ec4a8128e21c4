import type { LoadedCloud } from "../cloud/cloud.ts";
import { bytesOf, numberReader, type NumberReader, type NumberType } from "../../src/ts/formats/numbers.js";
import { LONGEST_PCD_HEADER, type PcdHeader, readPcdHeader, unpackPcd } from "../../src/ts/formats/pcd.js";
import { rowBytes } from "../../src/ts/formats/rows.js";
import { bytes, type Reading } from "./blocks.ts";
import { checkByteLength } from "./limits.ts";
import { builderFor, checkEnd, endOfRows, otherColumns, type Points, readBinaryRows, readTextRows } from "./rows.ts";

const COLOR = /^rgba?$/;

export async function readPcd(reading: Reading): Promise<LoadedCloud> {
  const { name, blob } = reading;
  const header = readPcdHeader(new Uint8Array(await bytes(name, blob, 0, LONGEST_PCD_HEADER)));
  const cloud = await readPoints(reading, header);
  return { ...cloud, ...packedColors(cloud), ...taken(header) };
}

async function readPoints(
  reading: Reading,
  { data, points: group, axes, end, lines }: PcdHeader,
): Promise<LoadedCloud> {
  // A color has four bytes and may have the type float. Reading it as a float would change the bytes that are not a
  // number.
  const typeOf = (name: string, type: NumberType) =>
    COLOR.test(name) && data !== "ascii" && bytesOf(type) === 4 ? "uint32" : type;
  const columns = otherColumns(group, axes, (name) => name, typeOf);
  const others = columns.sort((a, b) => Number(COLOR.test(b.name)) - Number(COLOR.test(a.name)));
  const points = { group, axes, others };
  if (data === "ascii") return readTextRows(reading, { start: end, firstNumber: lines.length + 1 }, [group], points);
  if (data === "binary_compressed") return readCompressed(reading, end, points);
  const cloud = await readBinaryRows(reading, end, points);
  await checkEnd(reading, await endOfRows(reading, end, group, true), group.name);
  return cloud;
}

/** Compressed files hold field after field: all x, all y, all z. */
async function readCompressed(reading: Reading, start: number, points: Points): Promise<LoadedCloud> {
  const { name, blob } = reading;
  const { group, axes, others } = points;
  const { count, fields } = group;
  checkByteLength(name, blob.size);
  checkByteLength(name, rowBytes(fields) * count);
  const view = new DataView(unpackPcd(new Uint8Array(await bytes(name, blob, start, blob.size)), group).buffer);

  const reader = (field: number, type: NumberType): NumberReader =>
    numberReader(type, rowBytes(fields.slice(0, field)) * count, true);
  const [x, y, z] = axes.map((axis) => reader(axis, fields[axis]!.type)) as [NumberReader, NumberReader, NumberReader];
  const readers = others.map(({ field, type }) => ({ read: reader(field, type), bytes: bytesOf(type) }));
  const strides = axes.map((axis) => bytesOf(fields[axis]!.type)) as [number, number, number];
  const builder = builderFor(reading, points);
  for (let row = 0; row < count; row++) {
    if (!builder.takes()) continue;
    const i = builder.put(x(view, row * strides[0]), y(view, row * strides[1]), z(view, row * strides[2]));
    for (let k = 0; k < readers.length; k++) builder.values[k]![i] = readers[k]!.read(view, row * readers[k]!.bytes);
  }
  return builder.finish();
}

/** A color is four bytes in one number. A text may write them as the float with the same bytes. */
function packedColors({
  colors,
  attributes = [],
  fields = [],
}: LoadedCloud): Pick<LoadedCloud, "colors" | "attributes" | "fields"> {
  const packed = attributes.find(({ name }) => COLOR.test(name));
  if (!packed) return { colors, attributes, fields };
  const { values } = packed;
  const bits = values instanceof Float32Array ? new Uint32Array(values.buffer) : values;
  const bytes = new Uint8Array(3 * bits.length);
  for (let i = 0; i < bits.length; i++) {
    bytes[3 * i] = (bits[i]! >>> 16) & 255;
    bytes[3 * i + 1] = (bits[i]! >>> 8) & 255;
    bytes[3 * i + 2] = bits[i]! & 255;
  }
  return {
    colors: bytes,
    attributes: attributes.filter((attribute) => attribute !== packed),
    fields: fields.filter(({ name }) => name !== packed.name),
  };
}

/** The cloud of a depth camera, as rows and columns in the camera's coordinates: x to the right, y down, z ahead. */
function taken({ height, viewpoint }: PcdHeader): Pick<LoadedCloud, "taken" | "isGrid"> {
  if (!(height > 1)) return {};
  return { isGrid: true, taken: { up: "-y", from: viewpoint ? [...viewpoint] : [0, 0, 0] } };
}
