import { CloudBuilder, grown } from "../builder.js";
import type { CloudFile, Reading } from "../cloud-file.js";
import { Contradictions, FormatProblem } from "../problem.js";
import { eachRow, equalRecords } from "../read-rows.js";
import { BoxCheck, checkCounts, countStored } from "./check.js";
import { type LasDetails, readLasDetails } from "./details.js";
import { lasPosition } from "./header.js";
import { moduleOf } from "../wasm.js";
import { lazDamaged, openLaz } from "./laz.js";

export const DEGREES =
  "its x and y are degrees of longitude and latitude: project them to meters first, for example to UTM";

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
  const { decoder, chunks } = await openLaz(() => moduleOf(reading), header, source, header.head, found);
  const taker = new RecordTaker(header, reading, found, count);
  let rows = new Uint8Array();
  let taken = 0;
  for (const [i, chunk] of chunks.entries()) {
    signal?.throwIfAborted();
    onProgress?.(taken / Math.max(1, count));
    const bytes = await source.read(chunk.offset, chunk.offset + chunk.length);
    const says = decoder.decode(bytes, chunk.count, (view, place) => {
      if (reading.records) {
        const at = taken * rowBytes;
        if (at + rowBytes > rows.length) rows = grown(rows, Math.max(2 * rows.length, chunk.count * rowBytes, 1 << 16));
        rows.set(new Uint8Array(view.buffer, view.byteOffset + place, rowBytes), at);
      }
      taker.take(view, place);
      taken++;
    });
    if (says !== undefined) found.add(`chunk ${i + 1} of its points ${says}`);
  }
  if (taken === 0) throw lazDamaged();
  const cloud = taker.finish(taken === count);
  return reading.records ? { ...cloud, records: equalRecords(rows, 0, rowBytes) } : cloud;
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
    if (crs?.isAngular) this.#found.note(DEGREES);
    const cloud = this.#builder.finish();
    return { ...cloud, las, ...(crs && { crs }), notes: [...this.#found.notes, ...cloud.notes] };
  }
}
