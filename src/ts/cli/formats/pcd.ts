import type { ChosenColumns } from "../../formats/axes.js";
import { type PcdHeader, readPcdHeader, unpackPcd } from "../../formats/pcd.js";
import { bytesOf } from "../../formats/numbers.js";
import { type Group, rowBytes } from "../../formats/rows.js";
import { checkRest } from "../../formats/text.js";
import { fieldsSaid, type PointFile } from "./point-file.js";
import { endOfRows, type Points, readBinaryRows, readTextRows } from "./rows.js";

/** PCD: text, binary and compressed. A compressed file is written as plain binary. */
export function readPcd(file: Buffer, chosen?: ChosenColumns): PointFile {
  const header = readPcdHeader(file, chosen);
  const { data, points, axes, lines, end } = header;
  return {
    ...(data === "ascii"
      ? readTextRows(file, { start: end, firstNumber: lines.length + 1 }, [points], points, axes)
      : data === "binary"
        ? readBinary(file, header)
        : readBinaryRows(interleaved(unpackPcd(file.subarray(end), points), points), 0, points, axes)),
    leftOut: [],
    columns: fieldsSaid(points.fields, axes),
    header: ({ length }) => Buffer.from(headerOf(file, header, length), "latin1"),
  };
}

/** The header for another number of points. It is in Latin-1, which keeps every byte. */
function headerOf(file: Buffer, { lines, data }: PcdHeader, count: number): string {
  const values: Record<string, string> = {
    WIDTH: String(count),
    HEIGHT: "1",
    POINTS: String(count),
    DATA: data === "ascii" ? "ascii" : "binary",
  };
  return lines
    .map(({ start, end }) =>
      file.toString("latin1", start, end).replace(/^(\s*)(\w+)(\s+)\S+/, (same, indent, keyword: string, space) => {
        const value = values[keyword.toUpperCase()];
        return value === undefined ? same : `${indent}${keyword}${space}${value}`;
      }),
    )
    .join("");
}

function readBinary(file: Buffer, { points, axes, end }: PcdHeader): Points {
  const read = readBinaryRows(file, end, points, axes);
  checkRest(file.subarray(endOfRows(file, end, points, true)), points.name);
  return read;
}

/** Returns the data in rows. In `columns`, all values of a field come before all values of the next field. */
function interleaved(columns: Uint8Array, { fields, count }: Group): Uint8Array {
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
