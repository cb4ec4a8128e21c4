import { allocating, CloudBuilder } from "../builder.js";
import type { CloudFile, Reading } from "../cloud-file.js";
import { Contradictions } from "../contradictions.js";
import { FormatProblem } from "../problem.js";
import { eachRow, equalRecords } from "../read-rows.js";
import { BoxCheck, checkCounts, countStored } from "./check.js";
import { type LasDetails, readLasDetails } from "./details.js";
import { lasPosition } from "./header.js";
import { decodeChunk, forgetLazPerf, sharedLazPerf } from "./laz-perf.js";
import { chunkParts, lazDamaged, readChunks } from "./laz.js";
import { checkTail } from "./tail.js";

/** LAS, LAZ and COPC, in the order of the file. */
export async function readLas(reading: Reading): Promise<CloudFile> {
  const header = await readLasDetails(reading.source);
  if (header.count === 0) throw new FormatProblem("it has no points");
  const found = new Contradictions(reading.damaged);
  checkCounts(header, found);
  if (!header.compressed) {
    const count = await countStored(header, reading.source, found);
    const taker = new RecordTaker(header, reading, found, count);
    await eachRow(reading, { ...header, count }, (view, at) => {
      taker.take(view, at);
    });
    return { ...taker.finish(true), records: equalRecords(undefined, header.start, header.rowBytes) };
  }
  return readLaz(header, reading, found);
}

async function readLaz(header: LasDetails, reading: Reading, found: Contradictions): Promise<CloudFile> {
  const { source, onProgress, signal } = reading;
  const { rowBytes, count } = header;
  const chunks = await readChunks(header, source, header.head, found);
  const perf = await (reading.lazPerf ?? sharedLazPerf)();
  const taker = new RecordTaker(header, reading, found, count);
  const kept: Uint8Array[] = [];
  let taken = 0;
  for (const [i, chunk] of chunks.entries()) {
    signal?.throwIfAborted();
    onProgress?.(taken / Math.max(1, count));
    const bytes = await source.read(chunk.offset, chunk.offset + chunk.length);
    const parts = chunkParts(bytes, chunk.count, header);
    if (parts.says !== undefined) found.add(`chunk ${i + 1} of its points ${parts.says}`);
    const isLast = i === chunks.length - 1;
    const points = guarded(() => (isLast ? checkTail(perf, bytes, parts, header, found) : parts.points));
    const rows = reading.records ? new Uint8Array(points * rowBytes) : undefined;
    let row = 0;
    const take = (view: DataView, place: number) => {
      rows?.set(new Uint8Array(view.buffer, view.byteOffset + place, rowBytes), row * rowBytes);
      row++;
      taker.take(view, place);
    };
    guarded(() => {
      decodeChunk(perf, bytes, points, header, take);
    });
    if (rows) kept.push(rows);
    taken += row;
  }
  if (taken === 0) throw lazDamaged();
  const cloud = taker.finish(taken === count);
  return reading.records
    ? { ...cloud, records: equalRecords(concatenated(kept, taken * rowBytes), 0, rowBytes) }
    : cloud;
}

function concatenated(parts: readonly Uint8Array[], length: number): Uint8Array {
  const all = allocating(length, () => new Uint8Array(length));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

/** The decoder throws numbers, traps and aborts. Each of these means that the file is damaged. */
function guarded<T>(decode: () => T): T {
  try {
    return decode();
  } catch (cause) {
    if (cause instanceof FormatProblem) throw cause;
    forgetLazPerf();
    throw lazDamaged(cause);
  }
}

/** Takes the points of a LAS file, one record after another. */
export class RecordTaker {
  readonly #header: LasDetails;
  readonly #builder: CloudBuilder;
  readonly #box: BoxCheck;
  readonly #found: Contradictions;

  constructor(header: LasDetails, reading: Pick<Reading, "limit">, found: Contradictions, expected: number) {
    this.#header = header;
    this.#found = found;
    this.#box = new BoxCheck(header);
    this.#builder = new CloudBuilder("float64", header.columns, reading, expected);
  }

  take(view: DataView, at: number): void {
    const [x, y, z] = lasPosition(this.#header, view, at);
    this.#box.take(x, y, z);
    if (!this.#builder.takes()) return;
    const { columns } = this.#header;
    const i = this.#builder.put(x, y, z);
    for (let k = 0; k < columns.length; k++) this.#builder.values[k]![i] = columns[k]!.read(view, at);
  }

  /** @param isWhole whether all points of the file were taken */
  finish(isWhole: boolean): CloudFile {
    this.#box.finish(isWhole, this.#found);
    const { crs, las } = this.#header;
    const cloud = this.#builder.finish();
    return { ...cloud, las, ...(crs && { crs }), notes: [...this.#found.notes, ...cloud.notes] };
  }
}
