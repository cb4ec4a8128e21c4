// Which bytes of a LAZ file are which of its points.
import type { Contradictions } from "../contradictions.js";
import { FormatProblem } from "../problem.js";
import { type Source, viewOf } from "../source.js";
import { decodeDifferences } from "./arithmetic.js";
import type { LasHeader } from "./header.js";
import type { ChunkLayout } from "./laz-perf.js";

/** A part of the file that can be decompressed alone. */
export interface Chunk {
  offset: number;
  length: number;
  count: number;
}

/** For each point format that laz-perf decompresses: the types of its parts, in the record of LAZ, and its layers. */
const FORMATS: Partial<Record<number, { items: readonly number[]; bytes: number; layers?: number }>> = {
  0: { items: [6], bytes: 20 },
  1: { items: [6, 7], bytes: 28 },
  2: { items: [6, 8], bytes: 26 },
  3: { items: [6, 7, 8], bytes: 34 },
  6: { items: [10], bytes: 30, layers: 9 },
  7: { items: [10, 11], bytes: 36, layers: 10 },
  8: { items: [10, 12], bytes: 38, layers: 11 },
};
/** The types of bytes that a file adds to each point, in points and in layers. */
const EXTRA_ITEMS = [0, 14];
/** The number of points of a chunk, if the table gives a number for each. */
const VARIABLE = 2 ** 32 - 1;
const MOST_CHUNKS = 2 ** 26;

export function lazDamaged(cause?: unknown): FormatProblem {
  return new FormatProblem("its compressed points cannot be decompressed", { cause });
}

export function lasEndsEarly(count: number): FormatProblem {
  return new FormatProblem(`it ends before the ${count.toLocaleString("en-US")} points that its header promises`);
}

/** Refuses compressed points that laz-perf does not support. */
export function checkLazFormat(format: number): NonNullable<(typeof FORMATS)[number]> {
  const known = FORMATS[format];
  if (!known) throw new FormatProblem(`its compressed points have format ${format}, which laz-perf cannot decompress`);
  return known;
}

/** The number of points in each chunk, as the record of LAZ says it. Refuses points that are not as the header says. */
function chunkSize({ format, rowBytes, records }: LasHeader, head: DataView): number {
  const known = checkLazFormat(format);
  const record = records.find(({ user, id }) => user === "laszip encoded" && id === 22_204);
  if (!record || record.length < 34) throw new FormatProblem("it does not say how its points are compressed");
  const { at, length } = record;
  const compressor = head.getUint16(at, true);
  const count = head.getUint16(at + 32, true);
  const items = Array.from({ length: Math.min(count, Math.floor((length - 34) / 6)) }, (_, i) =>
    [0, 2].map((byte) => head.getUint16(at + 34 + 6 * i + byte, true)),
  );
  const types = items.map(([type]) => type!).filter((type) => !EXTRA_ITEMS.includes(type));
  const bytes = items.reduce((sum, [, size]) => sum + size!, 0);
  if (compressor !== (known.layers ? 3 : 2)) {
    throw new FormatProblem(
      `its points are compressed in a way (${compressor}) that its format ${format} does not have`,
    );
  }
  if (types.join() !== known.items.join() || bytes !== rowBytes || rowBytes < known.bytes) {
    throw new FormatProblem("its header and its record of LAZ describe different points");
  }
  return head.getUint32(at + 12, true);
}

/**
 * The chunks of a file, by the table at its end. They must fill the place before it, and hold all points. The chunks of a
 * damaged file without a usable table are looked for one after another.
 */
export async function readChunks(
  header: LasHeader,
  source: Source,
  head: DataView,
  found: Contradictions,
): Promise<Chunk[]> {
  const { start, count } = header;
  const size = chunkSize(header, head);
  const table = await readTable(header, source, size === VARIABLE);
  if ("says" in table) {
    found.add(table.says);
    return chunksWithoutTable(header, source, size);
  }
  const { lengths, counts } = table;
  const chunks: Chunk[] = [];
  let [offset, points] = [start + 8, 0];
  for (let i = 0; i < lengths.length; i++) {
    const own = counts?.[i] ?? Math.max(0, Math.min(size, count - points));
    chunks.push({ offset, length: lengths[i]!, count: own });
    offset += lengths[i]!;
    points += own;
  }
  if (points !== count || (!counts && chunks.length !== Math.ceil(count / size))) {
    found.add(`its header promises ${count} points, and the table of its ${chunks.length} chunks others`);
  }
  return chunks;
}

/** The lengths and, if they differ, the numbers of points of all chunks; or how the table contradicts the file. */
async function readTable(
  { start, count }: LasHeader,
  source: Source,
  isVariable: boolean,
): Promise<{ lengths: Uint32Array; counts: Uint32Array | undefined } | { says: string }> {
  const number = async (place: number) => {
    const part = await source.read(place, place + 8);
    return part.length < 8 ? undefined : viewOf(part);
  };
  const place = async (at: number) => Number((await number(at))?.getBigInt64(0, true) ?? 0);
  const first = await place(start);
  // A program that writes to a stream stores the table's place at the very end.
  const at = first === -1 ? await place(source.size - 8) : first;
  const top = at < start + 8 ? undefined : await number(at);
  if (top === undefined) return { says: lasEndsEarly(count).message };
  const chunks = top.getUint32(4, true);
  const says = "the table of its compressed chunks contradicts the places of the chunks";
  // Each chunk holds a point.
  if (top.getUint32(0, true) !== 0 || chunks > Math.min(count, MOST_CHUNKS)) return { says };
  const packed = await source.read(at + 8, at + 8 + 16 * chunks + 64);
  const columns = decodeDifferences(packed, chunks, isVariable ? 2 : 1);
  const lengths = columns?.at(-1);
  const end = lengths?.reduce((sum, length) => sum + length, start + 8);
  return end === at ? { lengths: lengths!, counts: isVariable ? columns![0] : undefined } : { says };
}

/** Layered chunks follow one another and say their lengths. Of the older ones, only the beginning of the first is known. */
async function chunksWithoutTable(header: LasHeader, source: Source, size: number): Promise<Chunk[]> {
  const { format, rowBytes, start, count } = header;
  const chunks: Chunk[] = [];
  const { layers, bytes } = FORMATS[format]!;
  if (layers === undefined) {
    const offset = start + 8;
    return [{ offset, length: source.size - offset, count: Math.min(size, count) }];
  }
  const own = layers + rowBytes - bytes;
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

/** The inside of a chunk. */
export interface ChunkParts {
  /** The number of its points. */
  points: number;
  /** Where its layers begin, and where the last one ends. Chunks of the older formats are one layer. */
  at: number[];
  /** In words: how it contradicts itself. */
  says?: string;
}

/**
 * Layered chunks hold their first point, the number of their points, the size of each layer, and the layers. These are
 * checked first, since the decoder itself reads on beyond the end.
 */
export function chunkParts(chunk: Uint8Array, count: number, { format, rowBytes }: ChunkLayout): ChunkParts {
  const { layers, bytes } = FORMATS[format]!;
  if (layers === undefined) {
    const isShort = chunk.length < rowBytes;
    return { points: isShort ? 0 : count, at: [rowBytes, chunk.length], ...(isShort && { says: tooShort(chunk) }) };
  }
  // Each extra byte of a point has its own layer.
  const own = layers + rowBytes - bytes;
  const head = rowBytes + 4 + 4 * own;
  if (chunk.length < head) return { points: 0, at: [], says: tooShort(chunk) };
  const view = viewOf(chunk);
  const at = [head];
  for (let layer = 0; layer < own; layer++) at.push(at[layer]! + view.getUint32(rowBytes + 4 + 4 * layer, true));
  const end = at.at(-1)!;
  if (end !== chunk.length) return { points: 0, at, says: `is listed with ${chunk.length} bytes, but holds ${end}` };
  const points = view.getUint32(rowBytes, true);
  return { points, at, ...(points !== count && { says: `is listed with ${count} points, but holds ${points}` }) };
}

function tooShort(chunk: Uint8Array): string {
  return `has ${chunk.length} bytes, too few for a chunk of points`;
}
