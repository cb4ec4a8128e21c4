import type { ChosenColumns } from "../../formats/axes.js";
import { type PlyHeader, readPlyHeader } from "../../formats/ply.js";
import { checkRest } from "../../formats/text.js";
import { fieldsSaid, type PointFile } from "./point-file.js";
import { endOfRows, type Points, readBinaryRows, readTextRows } from "./rows.js";

/** PLY, ASCII and binary. Only the vertices are kept: faces would point to vertices that are gone. */
export function readPly(file: Buffer, chosen?: ChosenColumns): PointFile {
  const header = readPlyHeader(file, chosen);
  const { elements, vertices, axes, lines, end } = header;
  const points =
    header.format === "ascii"
      ? readTextRows(file, { start: end, firstNumber: lines.length + 1 }, elements, vertices, axes)
      : readBinary(file, header);
  return {
    ...points,
    leftOut: elements.filter((one) => one !== vertices && one.count > 0).map(({ name, count }) => `${count} × ${name}`),
    columns: fieldsSaid(vertices.fields, axes),
    header: ({ length }) => Buffer.from(headerOf(file, header, length), "latin1"),
  };
}

/** The header for another number of points. It is in Latin-1, which keeps every byte. */
function headerOf(file: Buffer, { lines }: PlyHeader, count: number): string {
  return lines
    .filter(({ element }) => element === undefined || element === "vertex")
    .map(({ start, end }) => file.toString("latin1", start, end))
    .map((text) => text.replace(/^(\s*element\s+vertex\s+)\d+/, `$1${count}`))
    .join("");
}

function readBinary(file: Buffer, { format, elements, vertices, axes, end }: PlyHeader): Points {
  const littleEndian = format === "binary_little_endian";
  let at = end;
  let points: Points | undefined;
  for (const element of elements) {
    if (element === vertices) points = readBinaryRows(file, at, vertices, axes, littleEndian);
    at = endOfRows(file, at, element, littleEndian);
  }
  checkRest(file.subarray(at), elements.at(-1)!.name);
  return points!;
}
