// Reads rows that a header describes, from a file that is completely in memory.
import { checkByteOrder } from "../../formats/byte-order.js";
import { fitSingle, numberReader } from "../../formats/numbers.js";
import { endsEarly } from "../../formats/problem.js";
import { type Axes, type Group, hasLists, rowBytes, walkRow } from "../../formats/rows.js";
import { TextRows } from "../../formats/text-rows.js";
import { LinePoints, linesOf } from "./lines.js";
import { equalRecords, type PointFile } from "./point-file.js";

export type Points = Pick<PointFile, "positions" | "records">;

/** Reads rows of text. The first row begins at `start`, and its line has the number `firstNumber`. */
export function readTextRows(
  file: Buffer,
  { start, firstNumber }: { start: number; firstNumber: number },
  groups: readonly Group[],
  points: Group,
  axes: Axes,
): Points {
  const rows = new TextRows(groups, points, axes);
  const found = new LinePoints(file);
  for (const line of linesOf(file, start, firstNumber)) {
    const point = rows.take(line.text, line.number);
    if (point !== undefined) found.add(line, point.position);
  }
  rows.finish();
  const positions = roomFor(points, axes);
  positions.set(found.numbers);
  return { positions, records: found.records };
}

/** Reads binary rows. */
export function readBinaryRows(
  bytes: Uint8Array,
  start: number,
  points: Group,
  axes: Axes,
  littleEndian = true,
): Points {
  const { name, count, fields } = points;
  const view = viewOf(bytes);
  const size = rowBytes(fields);
  // This check comes before memory is allocated, because a header may promise any number of rows.
  const found = Math.floor((bytes.length - start) / size);
  if (found < count) throw endsEarly(found, count, name);
  const positions = roomFor(points, axes);
  const readers = axes.map((axis) => numberReader(fields[axis]!.type, 0, littleEndian));

  if (hasLists(fields)) {
    const starts = new Float64Array(count + 1).fill(start, 0, 1);
    const begins: number[] = [];
    for (let i = 0; i < count; i++) {
      const end = walkRow(view, fields, littleEndian, starts[i]!, begins);
      if (end === undefined) throw endsEarly(i, count, name);
      for (let k = 0; k < 3; k++) positions[3 * i + k] = readers[k]!(view, begins[axes[k]!]!);
      starts[i + 1] = end;
    }
    return { positions, records: { bytes, start: (i) => starts[i]!, end: (i) => starts[i + 1]! } };
  }

  checkByteOrder(viewOf(bytes.subarray(start, start + size * count)), fields, axes, littleEndian);
  const offsets = axes.map((axis) => start + rowBytes(fields.slice(0, axis)));
  for (let i = 0; i < count; i++) {
    for (let k = 0; k < 3; k++) positions[3 * i + k] = readers[k]!(view, i * size + offsets[k]!);
  }
  return { positions, records: equalRecords(bytes, start, size) };
}

/** The place where the rows of a group end. */
export function endOfRows(
  bytes: Uint8Array,
  start: number,
  { name, count, fields }: Group,
  littleEndian: boolean,
): number {
  if (!hasLists(fields)) {
    const size = rowBytes(fields);
    const end = start + size * count;
    if (end > bytes.length) throw endsEarly(Math.floor((bytes.length - start) / size), count, name);
    return end;
  }
  const view = viewOf(bytes);
  let at = start;
  const begins: number[] = [];
  for (let i = 0; i < count; i++) {
    const end = walkRow(view, fields, littleEndian, at, begins);
    if (end === undefined) throw endsEarly(i, count, name);
    at = end;
  }
  return at;
}

function viewOf(bytes: Uint8Array): DataView {
  return new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
}

function roomFor({ count, fields }: Group, axes: Axes): PointFile["positions"] {
  const single = fitSingle(axes.map((axis) => fields[axis]!.type));
  return single ? new Float32Array(3 * count) : new Float64Array(3 * count);
}
