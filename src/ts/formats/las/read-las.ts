import { CloudBuilder, grown } from "../builder.js";
import type { CloudFile, Reading } from "../cloud-file.js";
import { Contradictions, FormatProblem } from "../problem.js";
import { eachRow, equalRecords } from "../read-rows.js";
import { type LasDetails, readLasDetails } from "./details.js";
import { LAS_RECORD_HEADER, lasPosition } from "./header.js";
import { moduleOf } from "../wasm.js";
import { lasEndsEarly, lazDamaged, openLaz } from "./laz.js";
import { type Source, viewOf } from "../source.js";
import { byteText } from "../text.js";

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

// Where a LAS file contradicts itself: its header, the places of its points, and the points.

type Triple = readonly [number, number, number];
const AXES = [0, 1, 2] as const;
/** How much of a step of the scale a bound may lie off the grid of coordinates. */
const OFF_GRID = 0.01;
const LARGEST = Number.MAX_VALUE;

const number = new Intl.NumberFormat("en-US");

/** Compares the counts in the header with each other. */
export function checkCounts({ minor, count, head }: LasDetails, found: Contradictions): void {
  const old = head.getUint32(107, true);
  if (minor === 4 && old > 0 && old !== count) {
    found.note(`its header promises ${count} points, and ${old} in its older field`);
  }
}

/**
 * The number of points of an uncompressed file that are there. The rest of the file must be too short for another point,
 * unless it is filled with zeros.
 */
export async function countStored(header: LasDetails, source: Source, found: Contradictions): Promise<number> {
  const { count, rowBytes, start, head } = header;
  const stored = Math.floor((source.size - start) / rowBytes);
  if (stored < count) {
    found.add(lasEndsEarly(count).message);
    return stored;
  }
  const end = start + count * rowBytes;
  let next = source.size;
  for (const at of placesAfter(header, head)) {
    if (at >= end) next = Math.min(next, at);
    else if (await isRecordAt(at, source)) found.add("the records after its points begin among them");
    else found.note("its header says that records begin among its points, and there are none");
  }
  const rest = await source.read(end, Math.min(next, end + rowBytes));
  if (rest.length >= rowBytes && rest.some((byte) => byte !== 0)) {
    found.add(`it goes on after the ${number.format(count)} points that its header promises`);
  }
  return count;
}

/** Where records may follow the points: the wave forms since version 1.3, and those of 1.4 if there are any. */
function placesAfter({ minor }: LasDetails, head: DataView): number[] {
  const waves = minor >= 3 ? Number(head.getBigUint64(227, true)) : 0;
  const records = minor === 4 && head.getUint32(243, true) > 0 ? Number(head.getBigUint64(235, true)) : 0;
  return [waves, records].filter((at) => at > 0);
}

/** Whether a record begins at a place: the name of its program, and a length that fits. */
async function isRecordAt(at: number, { size, read }: Source): Promise<boolean> {
  const head = await read(at, at + LAS_RECORD_HEADER.after);
  if (head.length < LAS_RECORD_HEADER.after) return false;
  const name = byteText(head.subarray(2, 18));
  const length = Number(viewOf(head).getBigUint64(20, true));
  return /^[A-Za-z][ -~]*\0*$/.test(name) && at + head.length + length <= size;
}

/** Compares points with the box in the header. */
export class BoxCheck {
  readonly #low = [Infinity, Infinity, Infinity];
  readonly #high = [-Infinity, -Infinity, -Infinity];
  readonly #header: LasDetails;
  readonly #margin: Triple;
  readonly #isSet: boolean;
  #outside = 0;

  constructor(header: LasDetails) {
    this.#header = header;
    const { low, high, scale } = header;
    // Writers round the box, by a step at most. A box far from zero is rounded in floating point, too.
    this.#margin = AXES.map(
      (axis) => Math.abs(scale[axis]) + 2 ** -50 * Math.max(Math.abs(low[axis]), Math.abs(high[axis])),
    ) as unknown as Triple;
    // A writer that cannot go back to its header leaves zeros, or the box of no points.
    const all = [...low, ...high];
    this.#isSet = !all.every((bound) => bound === 0) && !all.some((bound) => Math.abs(bound) >= LARGEST);
  }

  take(x: number, y: number, z: number): void {
    const point = [x, y, z];
    const { low, high } = this.#header;
    let isOutside = false;
    for (const axis of AXES) {
      const value = point[axis]!;
      if (value < this.#low[axis]!) this.#low[axis] = value;
      if (value > this.#high[axis]!) this.#high[axis] = value;
      isOutside ||= !(value >= low[axis] - this.#margin[axis] && value <= high[axis] + this.#margin[axis]);
    }
    if (isOutside) this.#outside++;
  }

  /** @param isWhole whether all points of the file were taken */
  finish(isWhole: boolean, found: Contradictions): void {
    if (!this.#isSet) return;
    if (this.#outside > 0) {
      found.add(`${number.format(this.#outside)} of its points lie outside the bounds that its header gives`);
    } else if (isWhole && AXES.some((axis) => this.#isForeign(axis))) {
      found.note("the bounds in its header are wider than its points, and on no grid of theirs");
    }
  }

  /** Whether a bound is neither at the points nor on the grid of coordinates, on which the box of any other cloud is. */
  #isForeign(axis: 0 | 1 | 2): boolean {
    const { low, high, scale, offset } = this.#header;
    const far = 2 ** -50 * Math.max(Math.abs(low[axis]), Math.abs(high[axis]), Math.abs(offset[axis]));
    return [low[axis] - this.#low[axis]!, high[axis] - this.#high[axis]!].some((distance, side) => {
      if (Math.abs(distance) <= this.#margin[axis]) return false;
      const steps = ((side === 0 ? low : high)[axis] - offset[axis]) / scale[axis];
      return Math.abs(steps - Math.round(steps)) > OFF_GRID + far / Math.abs(scale[axis]);
    });
  }
}
