// Which bytes of a LAZ file are which of its points, and their decoder.
import type { WasmModule } from "../../instance/compile.js";
import { type Contradictions, FormatProblem } from "../problem.js";
import { isTooMuch, type Source, viewOf } from "../source.js";
import { FilesWasm } from "../wasm.js";
import type { LasHeader } from "./header.js";

/** A part of the file that can be decompressed alone. */
export interface Chunk {
  offset: number;
  length: number;
  count: number;
}

/** How the points of a chunk are stored. */
export interface ChunkLayout {
  format: number;
  /** The number of bytes of a point. */
  rowBytes: number;
}

/** For each point format: the types of its parts, in the record of LAZ. */
const ITEMS: readonly (readonly number[])[] = [
  [6], [6, 7], [6, 8], [6, 7, 8], [6, 7, 9], [6, 7, 8, 9], [10], [10, 11], [10, 12], [10, 13], [10, 12, 13],
]; // prettier-ignore
/** The types of bytes that a file adds to each point, in points and in layers. */
const EXTRA_ITEMS = [0, 14];
/** In this way of compression, the first of all, all points are one chunk. */
const ONE_CHUNK = 1;
/** Formats from this one on are compressed in layers, which say how many points they hold. */
const FIRST_LAYERED = 6;
/** The number of points of a chunk, if the table gives a number for each. Some writers give 0. */
const VARIABLE = [0, 2 ** 32 - 1];
/** Grids without heights are 400 times as large as their compressed points. */
const RATIO = 500;

export function lazDamaged(cause?: unknown): FormatProblem {
  return new FormatProblem("its compressed points cannot be decompressed", { cause });
}

export function lasEndsEarly(count: number): FormatProblem {
  return new FormatProblem(`it ends before the ${count.toLocaleString("en-US")} points that its header promises`);
}

/** The decoder of one file. */
export class LazDecoder {
  readonly #module: WasmModule;
  readonly #layout: ChunkLayout;
  readonly #version: number;
  #wasm!: FilesWasm;
  /** The bytes of all chunks so far, and of their points. */
  #packed = 0;
  #unpacked = 0;

  /** @param version that of the parts of a point, in the record of LAZ */
  constructor(module: WasmModule, layout: ChunkLayout, version = layout.format < FIRST_LAYERED ? 2 : 3) {
    [this.#module, this.#layout, this.#version] = [module, layout, version];
    this.#start();
  }

  #start(): void {
    const { format, rowBytes } = this.#layout;
    this.#wasm = new FilesWasm(this.#module);
    this.#wasm.answer(this.#wasm.functions.begin_laz(format, rowBytes, this.#version));
  }

  /**
   * Decompresses a chunk. `take` gets a view with the bytes of each point at a place. Returns in words how the chunk
   * contradicts itself. Points before a damaged place are taken.
   */
  decode(chunk: Uint8Array, count: number, take: (view: DataView, at: number) => void): string | undefined {
    const { rowBytes } = this.#layout;
    let says: string | undefined;
    try {
      this.#wasm.put(chunk);
      const points = this.#wasm.answer(this.#wasm.functions.begin_chunk(count)) >>> 0;
      this.#packed += chunk.length;
      this.#unpacked += Math.max(points, count) * rowBytes;
      if (isTooMuch(this.#unpacked, this.#packed, RATIO)) {
        return `promises ${Math.max(points, count)} points in ${chunk.length} bytes`;
      }
      if (points !== count) says = `is listed with ${count} points, but holds ${points}`;
      for (;;) {
        const rows = this.#wasm.answer(this.#wasm.functions.next_points());
        if (rows === 0) return says;
        const view = viewOf(this.#wasm.bytes(this.#wasm.functions.bytes_at(), rows * rowBytes));
        for (let row = 0; row < rows; row++) take(view, row * rowBytes);
      }
    } catch (cause) {
      if (cause instanceof FormatProblem) return cause.message;
      if (!(cause instanceof WebAssembly.RuntimeError)) throw cause;
      // After a trap the instance is given up.
      this.#start();
      return "cannot be decompressed";
    }
  }

  /** The table of chunks: their lengths, and their numbers of points if it has them. Undefined if it is damaged. */
  table(packed: Uint8Array, hasPoints: boolean): { counts: number[]; lengths: number[] } | undefined {
    this.#wasm.put(packed);
    const chunks = this.#wasm.functions.chunk_table(hasPoints);
    if (chunks < 0) return undefined;
    const numbers = Array.from(this.#wasm.numbers(2 * chunks));
    return { counts: numbers.filter((_, i) => i % 2 === 0), lengths: numbers.filter((_, i) => i % 2 === 1) };
  }
}

/** What the record of LAZ says. Refuses points that are not as the header says. */
function recordOf({ format, rowBytes, records }: LasHeader, head: DataView) {
  const record = records.find(({ user, id }) => user === "laszip encoded" && id === 22_204);
  if (!record || record.length < 34) throw new FormatProblem("it does not say how its points are compressed");
  const { at, length } = record;
  const compressor = head.getUint16(at, true);
  const count = Math.min(head.getUint16(at + 32, true), Math.floor((length - 34) / 6));
  const items = Array.from({ length: count }, (_, i) => {
    const [type, size, version] = [0, 2, 4].map((byte) => head.getUint16(at + 34 + 6 * i + byte, true));
    return { type: type!, size: size!, version: version! };
  });
  const types = items.map(({ type }) => type).filter((type) => !EXTRA_ITEMS.includes(type));
  const bytes = items.reduce((sum, { size }) => sum + size, 0);
  const version = items[0]?.version ?? 0;
  const isLayered = format >= FIRST_LAYERED;
  if (isLayered ? compressor !== 3 : compressor !== 2 && compressor !== ONE_CHUNK) {
    throw new FormatProblem(
      `its points are compressed in a way (${compressor}) that its format ${format} does not have`,
    );
  }
  if (types.join() !== ITEMS[format]!.join() || bytes !== rowBytes) {
    throw new FormatProblem("its header and its record of LAZ describe different points");
  }
  const other = items.find((item) => item.version !== version || (isLayered ? item.version !== 3 : item.version > 2));
  if (other) {
    const way = "write it with the usual version of LASzip (3 for formats from 6 on, else 2)";
    throw new FormatProblem(
      `its points are compressed as LAZ item version ${other.version}, which is not read; ${way}`,
    );
  }
  return { version, isOne: compressor === ONE_CHUNK, size: head.getUint32(at + 12, true) };
}

/**
 * The decoder of a file, and its chunks by the table at its end. They must fill the place before it, and hold all points.
 * The chunks of a damaged file without a usable table are looked for one after another.
 */
export async function openLaz(
  module: () => Promise<WasmModule>,
  header: LasHeader,
  source: Source,
  head: DataView,
  found: Contradictions,
): Promise<{ decoder: LazDecoder; chunks: Chunk[] }> {
  const { start, count } = header;
  const { version, isOne, size } = recordOf(header, head);
  const place = isOne ? 0 : await placeOfTable(header, source);
  // A file that is cut is refused before the wasm is loaded.
  if (place === undefined) found.add(lasEndsEarly(count).message);
  const decoder = new LazDecoder(await module(), header, version);
  if (isOne) return { decoder, chunks: [{ offset: start, length: source.size - start, count }] };
  const isVariable = VARIABLE.includes(size);
  const table = place === undefined ? undefined : await readTable(header, source, place, isVariable, decoder);
  if (table === undefined) {
    if (place !== undefined) found.add("the table of its compressed chunks contradicts the places of the chunks");
    return { decoder, chunks: await chunksWithoutTable(header, source, isVariable ? count : size) };
  }
  const { lengths, counts } = table;
  const chunks: Chunk[] = [];
  let [offset, points] = [start + 8, 0];
  for (let i = 0; i < lengths.length; i++) {
    const own = isVariable ? counts[i]! : Math.max(0, Math.min(size, count - points));
    chunks.push({ offset, length: lengths[i]!, count: own });
    offset += lengths[i]!;
    points += own;
  }
  if (points !== count || (!isVariable && chunks.length !== Math.ceil(count / size))) {
    found.add(`its header promises ${count} points, and the table of its ${chunks.length} chunks others`);
  }
  return { decoder, chunks };
}

/** Where the table of chunks is; undefined if the file ends before it. */
async function placeOfTable({ start }: LasHeader, { size, read }: Source): Promise<number | undefined> {
  const place = async (at: number) => {
    const part = await read(at, at + 8);
    return part.length < 8 ? 0 : Number(viewOf(part).getBigInt64(0, true));
  };
  const first = await place(start);
  // A program that writes to a stream stores the table's place at the very end.
  const at = first === -1 ? await place(size - 8) : first;
  return at < start + 8 || at + 8 > size ? undefined : at;
}

/** The lengths and, if they differ, the numbers of points of all chunks. Undefined if they do not fill the place before. */
async function readTable(
  { start, count, rowBytes }: LasHeader,
  source: Source,
  at: number,
  isVariable: boolean,
  decoder: LazDecoder,
): Promise<ReturnType<LazDecoder["table"]>> {
  const top = viewOf(await source.read(at, at + 8));
  const chunks = top.getUint32(4, true);
  // Each chunk holds a point, and its first one is not compressed.
  if (top.getUint32(0, true) !== 0 || chunks > Math.min(count, (at - start - 8) / rowBytes)) return undefined;
  const table = decoder.table(await source.read(at, at + 8 + 16 * chunks + 64), isVariable);
  const end = table?.lengths.reduce((sum, length) => sum + length, start + 8);
  return end === at ? table : undefined;
}

/** Layered chunks follow one another and say their lengths. Of the older ones, only the beginning of the first is known. */
async function chunksWithoutTable(header: LasHeader, source: Source, size: number): Promise<Chunk[]> {
  const { format, rowBytes, start, count } = header;
  const chunks: Chunk[] = [];
  if (format < FIRST_LAYERED) {
    const offset = start + 8;
    return [{ offset, length: source.size - offset, count: Math.min(size, count) }];
  }
  // Each extra byte of a point has its own layer.
  const own = [9, 10, 11, 10, 12][format - FIRST_LAYERED]! + rowBytes - [30, 36, 38, 59, 67][format - FIRST_LAYERED]!;
  for (let at = start + 8, left = count; left > 0;) {
    const top = await source.read(at, at + rowBytes + 4 + 4 * own);
    if (top.length < rowBytes + 4 + 4 * own) break;
    const view = viewOf(top);
    const points = view.getUint32(rowBytes, true);
    let length = top.length;
    for (let layer = 0; layer < own; layer++) length += view.getUint32(rowBytes + 4 + 4 * layer, true);
    if (points === 0 || points > left || at + length > source.size) break;
    chunks.push({ offset: at, length, count: points });
    at += length;
    left -= points;
  }
  return chunks;
}
