// Reads rows that a header describes, from a file that is read a block at a time.
import { CloudBuilder } from "./builder.js";
import { checkByteOrder, ORDER_SAMPLE, type Axes, type Group, hasLists, rowBytes, walkRow, TextRows } from "./rows.js";
import type { CloudFile, Reading, Records } from "./cloud-file.js";
import { type Column, PACKED, fitSingle, numberReader, type NumberReader, type NumberType } from "./numbers.js";
import { Contradictions, endsEarly, FormatProblem } from "./problem.js";
import { BLOCK, blocks, lines, type Source, viewOf } from "./source.js";
import { restSays } from "./text.js";

/** A file's points, and the other fields that become columns. */
export interface Points {
  group: Group;
  axes: Axes;
  others: readonly (Column & { field: number })[];
}

function builderFor(reading: Reading, { group, axes, others }: Points): CloudBuilder {
  const single = fitSingle(axes.map((axis) => group.fields[axis]!.type));
  return new CloudBuilder(single ? "float32" : "float64", others, reading, group.count);
}

/** A text may have more digits than the floats of its header. Colors are the bytes of a float. */
function builderForText(reading: Reading, { group, others }: Points): CloudBuilder {
  const columns = others.map((other): Column =>
    other.type === "float32" && !PACKED.test(other.name) ? { ...other, type: "float64" } : other,
  );
  return new CloudBuilder("float64", columns, reading, group.count);
}

/** Reports the progress of reading, and ends it if that is asked for. */
export function step({ source, signal, onProgress }: Reading, at: number): void {
  signal?.throwIfAborted();
  // An empty file is read at once.
  onProgress?.(Math.min(1, at / Math.max(1, source.size)));
}

/** Reads rows in text. `start` is the place of the first line, `firstNumber` its number. */
export async function readTextRows(
  reading: Reading,
  { start, firstNumber }: { start: number; firstNumber: number },
  groups: readonly Group[],
  points: Points,
): Promise<CloudFile> {
  const { group, axes, others } = points;
  const found = new Contradictions(reading.damaged);
  const rows = new TextRows(groups, group, axes);
  const builder = builderForText(reading, points);
  const taken = (text: string, number: number) => {
    try {
      const point = rows.take(text, number);
      return point && { position: point.position, values: others.map(({ field }) => point.value(field)) };
    } catch (error) {
      found.leaveOut(error);
      return undefined;
    }
  };
  for await (const { texts, number, end, places } of lines(reading.source, start, firstNumber)) {
    const at = reading.records ? places() : undefined;
    for (let line = 0; line < texts.length; line++) {
      const point = taken(texts[line]!, number + line);
      if (point === undefined || !builder.takes()) continue;
      const i = builder.put(...point.position);
      if (at) builder.place(i, at[line]!, at[line + 1]!);
      for (let k = 0; k < others.length; k++) builder.values[k]![i] = point.values[k]!;
    }
    step(reading, end);
  }
  rows.finish(found);
  return noted(builder.finish(), found);
}

function noted(cloud: CloudFile, found: Contradictions): CloudFile {
  if (cloud.rows === 0 && found.notes.length > 0) throw new FormatProblem(found.notes.join("; "));
  return { ...cloud, notes: [...found.notes, ...cloud.notes] };
}

/** Reads binary rows from `start` on. */
export async function readBinaryRows(
  reading: Reading,
  start: number,
  given: Points,
  littleEndian = true,
): Promise<CloudFile> {
  const { source } = reading;
  const { axes, others } = given;
  const found = new Contradictions(reading.damaged);
  const { fields } = given.group;
  const size = rowBytes(fields);
  const stored = Math.max(0, Math.floor((source.size - start) / size));
  const isCut = stored < given.group.count;
  // This check comes before memory is allocated, because a header may promise any number of rows.
  if (isCut) found.add(endsEarly(stored, given.group.count, given.group.name).message);
  const points = isCut ? { ...given, group: { ...given.group, count: stored } } : given;
  const { group } = points;
  const { count } = group;
  const sample = await source.read(start, start + Math.min(count, ORDER_SAMPLE) * size);
  checkByteOrder(viewOf(sample), fields, axes, littleEndian);

  const builder = builderFor(reading, points);
  const lists = hasLists(fields);
  // Lists may have any length, so the places of the fields differ from row to row.
  const reader = (field: number, type: NumberType): NumberReader =>
    numberReader(type, lists ? 0 : rowBytes(fields.slice(0, field)), littleEndian);
  const [x, y, z] = axes.map((axis) => reader(axis, fields[axis]!.type)) as [NumberReader, NumberReader, NumberReader];
  const readers = others.map(({ field, type }) => reader(field, type));
  const put = (view: DataView, at: (field: number) => number) => {
    const i = builder.put(x(view, at(axes[0])), y(view, at(axes[1])), z(view, at(axes[2])));
    for (let k = 0; k < readers.length; k++) builder.values[k]![i] = readers[k]!(view, at(others[k]!.field));
    return i;
  };
  if (lists) {
    await eachListRow(reading, start, group, littleEndian, found, (view, starts, place, end) => {
      if (!builder.takes()) return;
      const i = put(view, (field) => starts[field]!);
      if (reading.records) builder.place(i, place, end);
    });
    return noted(builder.finish(), found);
  }
  await eachRow(reading, { start, rowBytes: size, count }, (view, at) => {
    if (builder.takes()) put(view, () => at);
  });
  return { ...noted(builder.finish(), found), records: equalRecords(undefined, start, size) };
}

/** Records of the same size, one after another. */
export function equalRecords(bytes: Uint8Array | undefined, from: number, size: number): Records {
  return { bytes, start: (index) => from + index * size, end: (index) => from + (index + 1) * size };
}

/** Reads `count` rows of `rowBytes` bytes each. Calls back with a view and the place of the row in it. */
export async function eachRow(
  reading: Reading,
  { start, rowBytes: size, count }: { start: number; rowBytes: number; count: number },
  onRow: (view: DataView, at: number) => void,
): Promise<void> {
  let left = count;
  if (left === 0) return;
  for await (const block of blocks(reading.source, start, size)) {
    const view = viewOf(block);
    const rows = Math.min(left, Math.floor(block.length / size));
    for (let row = 0; row < rows; row++) onRow(view, row * size);
    left -= rows;
    step(reading, start + (count - left) * size);
    if (left === 0) break;
  }
}

/** Walks over rows with lists, and returns where they end: at the end of the file, if it is cut. */
export async function eachListRow(
  reading: Reading,
  start: number,
  group: Group,
  littleEndian: boolean,
  found: Contradictions,
  onRow: (view: DataView, starts: readonly number[], place: number, end: number) => void,
): Promise<number> {
  const { source } = reading;
  const starts: number[] = [];
  let blockStart = start;
  let length = BLOCK;
  let view = viewOf(await source.read(start, start + length));
  let at = 0;
  for (let row = 0; row < group.count;) {
    const end = walkRow(view, group.fields, littleEndian, at, starts);
    if (end !== undefined) {
      onRow(view, starts, blockStart + at, blockStart + end);
      at = end;
      row++;
      continue;
    }
    if (blockStart + view.byteLength >= source.size) {
      found.add(endsEarly(row, group.count, group.name).message);
      return source.size;
    }
    // A row that does not fit into a block needs a longer block.
    if (at === 0) length *= 2;
    blockStart += at;
    at = 0;
    view = viewOf(await source.read(blockStart, blockStart + length));
    step(reading, blockStart);
  }
  return blockStart + at;
}

/** The place where the rows of a group end: at the end of the file, if it is cut. */
export async function endOfRows(
  reading: Reading,
  start: number,
  group: Group,
  littleEndian: boolean,
  found: Contradictions,
): Promise<number> {
  const { name, count, fields } = group;
  if (hasLists(fields)) return eachListRow(reading, start, group, littleEndian, found, () => undefined);
  const { size } = reading.source;
  const length = rowBytes(fields);
  const end = start + length * count;
  if (end > size) found.add(endsEarly(Math.max(0, Math.floor((size - start) / length)), count, name).message);
  return Math.min(end, size);
}

/** Checks one block after the last row: if a header lacks a field, much data is left over. */
export async function checkEnd({ read }: Source, end: number, what: string, found: Contradictions): Promise<void> {
  const says = restSays(await read(end, end + BLOCK), what);
  if (says !== undefined) found.add(says);
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
