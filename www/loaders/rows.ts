import type { LoadedCloud } from "../cloud/cloud.ts";
import { type Reading, bytes, eachRow, lines } from "./blocks.ts";
import { CloudBuilder, type Column } from "./builder.ts";
import { type NumberReader, numberReader, type NumberType } from "./numbers.ts";
import { LoadProblem } from "./problem.ts";

/** One number of a row: where it stands, in bytes in a binary file and by its turn in a text. */
export interface Field {
  name: string;
  type: NumberType;
  offset: number;
  word: number;
}

/** A file of equal rows, of which a header tells. */
export interface Rows {
  /** Where the first row begins in the file. */
  start: number;
  count: number;
  position: readonly [Field, Field, Field];
  others: readonly Field[];
  /** Text lines to be passed over first. */
  skip?: number;
}

/** Rows looked at to tell which byte order they are in. */
const SAMPLE = 1000;

export async function readBinaryRows(
  reading: Reading,
  rows: Rows,
  rowBytes: number,
  littleEndian = true,
): Promise<LoadedCloud> {
  const { start, count, position, others } = rows;
  if (count * rowBytes > reading.blob.size - start) throw endsEarly(reading.name, count);
  await checkByteOrder(reading, rows, rowBytes, littleEndian);

  const builder = builderFor(reading, rows);
  const [x, y, z] = position.map(({ type, offset }) => numberReader(type, offset, littleEndian)) as [
    NumberReader,
    NumberReader,
    NumberReader,
  ];
  const readers = others.map(({ type, offset }) => numberReader(type, offset, littleEndian));
  await eachRow(reading, { start, rowBytes, count }, (view, at) => {
    if (!builder.takes()) return;
    const i = builder.put(x(view, at), y(view, at), z(view, at));
    for (let k = 0; k < readers.length; k++) builder.values[k]![i] = readers[k]!(view, at);
  });
  return builder.finish();
}

export async function readTextRows(reading: Reading, rows: Rows): Promise<LoadedCloud> {
  const { name } = reading;
  const { start, count, position, others, skip = 0 } = rows;
  const builder = builderFor(reading, rows);
  const words = Math.max(...position.map((field) => field.word)) + 1;
  let toSkip = skip;
  /** A line that is too short: the last one of a file that was cut may be. */
  let short: string | null = null;
  reading: for await (const some of lines(reading, start)) {
    for (const line of some) {
      if (builder.rows === count) break reading;
      const trimmed = line.trim();
      if (trimmed === "" || toSkip-- > 0 || !builder.takes()) continue;
      const row = trimmed.split(/\s+/);
      if (/\d,\d/.test(trimmed))
        throw new LoadProblem(
          `${name} is broken: its numbers have commas (“${trimmed.slice(0, 40)}”), which such a file writes as points.`,
        );
      if (short !== null)
        throw new LoadProblem(`${name} is broken: a line has fewer numbers than its header promises (“${short}”).`);
      if (row.length < words) {
        short = trimmed.slice(0, 40);
        continue;
      }
      const i = builder.put(
        Number(row[position[0].word]),
        Number(row[position[1].word]),
        Number(row[position[2].word]),
      );
      for (let k = 0; k < others.length; k++) builder.values[k]![i] = Number(row[others[k]!.word]);
    }
  }
  if (builder.rows < count || short !== null) throw endsEarly(name, count);
  return builder.finish();
}

export function endsEarly(name: string, promised: number): LoadProblem {
  return new LoadProblem(
    `${name} is broken: it ends before the ${promised.toLocaleString("en-US")} points its header promises.`,
  );
}

function builderFor({ limit }: Reading, { position, others, count }: Rows): CloudBuilder {
  const columns: Column[] = others.map(({ name, type }) => ({ name, type }));
  // A four-byte float is a float, also where a text writes it with more digits.
  const single = position.every(({ type }) => type === "float32" || /8|16/.test(type));
  return new CloudBuilder(single ? "float32" : "float64", columns, limit, count);
}

/** Numbers read in the wrong order of bytes are all but never ones that anybody measures. */
async function checkByteOrder(
  { name, blob }: Reading,
  { start, count, position }: Rows,
  rowBytes: number,
  littleEndian: boolean,
): Promise<void> {
  const view = new DataView(await bytes(name, blob, start, start + Math.min(count, SAMPLE) * rowBytes));
  const odd = (little: boolean) => {
    let number = 0;
    for (const { type, offset } of position.filter(({ type }) => type.startsWith("float"))) {
      const read = numberReader(type, offset, little);
      for (let at = 0; at < view.byteLength; at += rowBytes) if (isOdd(read(view, at))) number++;
    }
    return (number * rowBytes) / (3 * view.byteLength);
  };
  if (count === 0 || odd(littleEndian) < 0.3 || odd(!littleEndian) > 0.01) return;
  const other = littleEndian ? "big" : "little";
  throw new LoadProblem(`${name} is broken: its numbers are ${other}-endian, and its header says that they are not.`);
}

function isOdd(value: number): boolean {
  const size = Math.abs(value);
  return !(size < 1e15) || (size > 0 && size < 1e-20);
}
