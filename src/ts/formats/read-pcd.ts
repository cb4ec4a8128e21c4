import type { CloudFile, Place, Reading } from "./cloud-file.js";
import { type FilledColumn, PACKED } from "./column.js";
import { Contradictions } from "./contradictions.js";
import { bytesOf, type NumberType } from "./numbers.js";
import { LONGEST_PCD_HEADER, type PcdHeader, readPcdHeader, unpackPcd } from "./pcd.js";
import { checkEnd, endOfRows, otherColumns, readBinaryRows, readTextRows } from "./read-rows.js";
import { fieldsSaid, type Group, listsIn, rowBytes } from "./rows.js";
import { bytesSource, checkByteLength } from "./source.js";

/** PCD: text, binary and compressed. */
export async function readPcd(reading: Reading): Promise<CloudFile> {
  const header = readPcdHeader(await reading.source.read(0, LONGEST_PCD_HEADER), reading.chosen);
  const cloud = await readPoints(reading, header);
  return {
    ...withoutPacked(cloud),
    ...taken(header),
    unread: listsIn(header.points),
    axes: fieldsSaid(header.points.fields, header.axes),
  };
}

async function readPoints(reading: Reading, { data, points: group, axes, end, lines }: PcdHeader): Promise<CloudFile> {
  // A color has four bytes and may have the type float. Reading it as a float would change the bytes that are not a
  // number.
  const typeOf = (name: string, type: NumberType) =>
    PACKED.test(name) && data !== "ascii" && bytesOf(type) === 4 ? "uint32" : type;
  const points = { group, axes, others: otherColumns(group, axes, (name) => name, typeOf) };
  if (data === "ascii") return readTextRows(reading, { start: end, firstNumber: lines.length + 1 }, [group], points);
  if (data === "binary") {
    const cloud = await readBinaryRows(reading, end, points);
    const found = new Contradictions(reading.damaged);
    await checkEnd(reading.source, await endOfRows(reading, end, group, true, found), group.name, found);
    return { ...cloud, notes: [...new Set([...cloud.notes, ...found.notes])] };
  }
  const { size } = reading.source;
  checkByteLength(size);
  checkByteLength(rowBytes(group.fields) * group.count);
  const rows = interleaved(unpackPcd(await reading.source.read(end, size), group), group);
  const { records, ...cloud } = await readBinaryRows({ ...reading, source: bytesSource(rows) }, 0, points);
  return { ...cloud, records: { ...records, bytes: rows } };
}

/** Returns the data in rows. In a compressed file, all values of a field come before all values of the next field. */
function interleaved(columns: Uint8Array, { fields, count }: Group): Uint8Array<ArrayBuffer> {
  const size = rowBytes(fields);
  const rows = new Uint8Array(columns.length);
  let [from, offset] = [0, 0];
  for (const field of fields) {
    const width = field.count * bytesOf(field.type);
    for (let i = 0; i < count; i++, from += width) {
      for (let byte = 0; byte < width; byte++) rows[i * size + offset + byte] = columns[from + byte]!;
    }
    offset += width;
  }
  return rows;
}

/** A color is four bytes in one number. A text may write them as the float with the same bytes. */
function withoutPacked(cloud: CloudFile): CloudFile {
  const found = cloud.columns.find(({ name }) => PACKED.test(name));
  if (!found) return cloud;
  return { ...cloud, columns: cloud.columns.filter((column) => column !== found), packed: unpackedColors(found) };
}

function unpackedColors({ values }: FilledColumn): Uint8Array<ArrayBuffer> {
  const bits = values instanceof Float32Array ? new Uint32Array(values.buffer) : values;
  const bytes = new Uint8Array(3 * bits.length);
  for (let i = 0; i < bits.length; i++) {
    bytes[3 * i] = (bits[i]! >>> 16) & 255;
    bytes[3 * i + 1] = (bits[i]! >>> 8) & 255;
    bytes[3 * i + 2] = bits[i]! & 255;
  }
  return bytes;
}

/**
 * The cloud of a depth camera, as rows and columns in the camera's coordinates: x to the right, y down, z ahead. Other
 * clouds have a station if their header tells of one: programs write 0 0 0 into all files.
 */
function taken({ height, viewpoint = [0, 0, 0] }: PcdHeader): Pick<CloudFile, "isGrid" | "up" | "stations"> {
  const stations = [{ name: "viewpoint", viewpoint: [...viewpoint] as Place }];
  if (height > 1) return { isGrid: true, up: "-y", stations };
  return viewpoint.some((value) => value !== 0) ? { stations } : {};
}
