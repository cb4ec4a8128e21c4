// Reads rows that a header describes, from a file that is read a block at a time.
import type { LoadedCloud } from "../cloud/cloud.ts";
import { checkByteOrder, ORDER_SAMPLE } from "../../src/ts/formats/byte-order.js";
import { fitSingle, numberReader, type NumberReader, type NumberType } from "../../src/ts/formats/numbers.js";
import { endsEarly } from "../../src/ts/formats/problem.js";
import { type Axes, type Group, hasLists, rowBytes, walkRow } from "../../src/ts/formats/rows.js";
import { TextRows } from "../../src/ts/formats/text-rows.js";
import { checkRest } from "../../src/ts/formats/text.js";
import { BLOCK, bytes, eachRow, lines, type Reading } from "./blocks.ts";
import { CloudBuilder, type Column } from "./builder.ts";

/** A file's points, and the other fields that become attributes and colors. */
export interface Points {
  group: Group;
  axes: Axes;
  others: readonly (Column & { field: number })[];
}

export function builderFor(reading: Reading, { group, axes, others }: Points): CloudBuilder {
  // If the type of a field is a four-byte float, it is read as such, even if a text has more digits.
  const single = fitSingle(axes.map((axis) => group.fields[axis]!.type));
  return new CloudBuilder(single ? "float32" : "float64", others, reading, group.count);
}

/** Reads rows in text. `start` is the place of the first line, `firstNumber` its number. */
export async function readTextRows(
  reading: Reading,
  { start, firstNumber }: { start: number; firstNumber: number },
  groups: readonly Group[],
  points: Points,
): Promise<LoadedCloud> {
  const { group, axes, others } = points;
  const rows = new TextRows(groups, group, axes);
  const builder = builderFor(reading, points);
  let number = firstNumber;
  for await (const some of lines(reading, start, { firstNumber })) {
    for (const line of some) {
      const point = rows.take(line, number++);
      if (point === undefined || !builder.takes()) continue;
      const i = builder.put(...point.position);
      for (let k = 0; k < others.length; k++)
        builder.values[k]![i] = Number(point.words[point.starts[others[k]!.field]!]);
    }
  }
  rows.finish();
  return builder.finish();
}

/** Reads binary rows from `start` on. */
export async function readBinaryRows(
  reading: Reading,
  start: number,
  points: Points,
  littleEndian = true,
): Promise<LoadedCloud> {
  const { name, blob } = reading;
  const { group, axes, others } = points;
  const { count, fields } = group;
  const size = rowBytes(fields);
  const found = Math.floor((blob.size - start) / size);
  if (found < count) throw endsEarly(found, count, group.name);
  const sample = await bytes(name, blob, start, start + Math.min(count, ORDER_SAMPLE) * size);
  checkByteOrder(new DataView(sample), fields, axes, littleEndian);

  const builder = builderFor(reading, points);
  const lists = hasLists(fields);
  // Lists may have any length, so the places of the fields differ from row to row.
  const reader = (field: number): NumberReader =>
    numberReader(fields[field]!.type, lists ? 0 : rowBytes(fields.slice(0, field)), littleEndian);
  const [x, y, z] = axes.map(reader) as [NumberReader, NumberReader, NumberReader];
  const readers = others.map(({ field, type }) =>
    numberReader(type, lists ? 0 : rowBytes(fields.slice(0, field)), littleEndian),
  );
  const put = (view: DataView, at: (field: number) => number) => {
    if (!builder.takes()) return;
    const i = builder.put(x(view, at(axes[0])), y(view, at(axes[1])), z(view, at(axes[2])));
    for (let k = 0; k < readers.length; k++) builder.values[k]![i] = readers[k]!(view, at(others[k]!.field));
  };
  if (lists) {
    await eachListRow(reading, start, group, littleEndian, (view, starts) => {
      put(view, (field) => starts[field]!);
    });
  } else {
    await eachRow(reading, { start, rowBytes: size, count }, (view, at) => {
      put(view, () => at);
    });
  }
  return builder.finish();
}

/** Skips rows with lists, and returns where they end. */
export async function eachListRow(
  { name, blob }: Reading,
  start: number,
  group: Group,
  littleEndian: boolean,
  onRow: (view: DataView, starts: readonly number[]) => void,
): Promise<number> {
  const starts: number[] = [];
  let blockStart = start;
  let length = BLOCK;
  let view = new DataView(await bytes(name, blob, start, start + length));
  let at = 0;
  for (let row = 0; row < group.count;) {
    const end = walkRow(view, group.fields, littleEndian, at, starts);
    if (end !== undefined) {
      onRow(view, starts);
      at = end;
      row++;
      continue;
    }
    if (blockStart + view.byteLength >= blob.size) throw endsEarly(row, group.count, group.name);
    // A row that does not fit into a block needs a longer block.
    if (at === 0) length *= 2;
    blockStart += at;
    at = 0;
    view = new DataView(await bytes(name, blob, blockStart, blockStart + length));
  }
  return blockStart + at;
}

/** The place where the rows of a group end. */
export async function endOfRows(reading: Reading, start: number, group: Group, littleEndian: boolean): Promise<number> {
  const { name, count, fields } = group;
  if (hasLists(fields)) return eachListRow(reading, start, group, littleEndian, () => undefined);
  const size = rowBytes(fields);
  const end = start + size * count;
  if (end > reading.blob.size) throw endsEarly(Math.floor((reading.blob.size - start) / size), count, name);
  return end;
}

/** Checks one block after the last row: if a header lacks a field, much data is left over. */
export async function checkEnd({ name, blob }: Reading, end: number, what: string): Promise<void> {
  checkRest(new Uint8Array(await bytes(name, blob, end, end + BLOCK)), what);
}

/** A column for each field that is a single number and not x, y or z. */
export function otherColumns(
  { fields }: Group,
  axes: Axes,
  called: (name: string) => string,
  typeOf: (name: string, type: NumberType) => NumberType = (_, type) => type,
): (Column & { field: number })[] {
  return fields.flatMap(({ name, type, count, length }, field) =>
    // Fields of several numbers are descriptors, histograms and padding.
    axes.includes(field) || count > 1 || length !== undefined
      ? []
      : [{ name: called(name), type: typeOf(name, type), field }],
  );
}
