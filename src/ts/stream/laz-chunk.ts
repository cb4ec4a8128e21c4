import { broken } from "./source.js";

/** The part of laz-perf that is used: `createLazPerf()` of the package `laz-perf` makes it. */
export interface LazPerf {
  readonly HEAPU8: Uint8Array;
  /** Takes memory of the decoder. */
  _malloc(bytes: number): number;
  /** Gives it back. */
  _free(pointer: number): void;
  ChunkDecoder: new () => {
    /** Begins with a chunk of compressed points. */
    open(format: number, recordLength: number, pointer: number): void;
    /** Writes the next point to an address. */
    getPoint(pointer: number): void;
    /** Ends the decoder. */
    delete(): void;
  };
}

/** How the points of a file are stored. */
export interface Records {
  format: number;
  /** The number of bytes of a point. */
  length: number;
}

/** The point formats of COPC: their number of bytes, and the layers of their colors. */
const FORMATS: Partial<Record<number, { bytes: number; colors: number }>> = {
  6: { bytes: 30, colors: 0 },
  7: { bytes: 36, colors: 1 },
  8: { bytes: 38, colors: 2 },
};

/** The layers of x and y, z, class, flags, intensity, angle, user data, source and time. */
const LAYERS = 9;

export function checkRecords(name: string, { format, length }: Records): void {
  const layout = FORMATS[format];
  if (layout === undefined || length < layout.bytes) {
    throw broken(name, `COPC has points of format 6, 7 or 8, but these have format ${format} and ${length} bytes`);
  }
}

/**
 * Decompresses the coordinates of one chunk of points: x, y, z as integers.
 *
 * A chunk holds its first point, the number of its points, the size of each layer, and the layers.
 * These are checked first, since the decoder itself reads on beyond the end.
 */
export function decompress(
  name: string,
  key: string,
  chunk: Uint8Array,
  count: number,
  records: Records,
  perf: LazPerf,
): Int32Array {
  checkChunk(name, key, chunk, count, records);
  const integers = new Int32Array(3 * count);
  const from = perf._malloc(chunk.length);
  const to = perf._malloc(records.length);
  const decoder = new perf.ChunkDecoder();
  try {
    perf.HEAPU8.set(chunk, from);
    decoder.open(records.format, records.length, from);
    for (let i = 0; i < count; i++) {
      decoder.getPoint(to);
      // If the memory has grown, its buffer has been replaced.
      const point = new DataView(perf.HEAPU8.buffer, to, 12);
      for (let axis = 0; axis < 3; axis++) integers[3 * i + axis] = point.getInt32(4 * axis, true);
    }
  } catch (cause) {
    throw broken(name, `the points of node ${key} cannot be decompressed`, cause);
  } finally {
    decoder.delete();
    perf._free(from);
    perf._free(to);
  }
  return integers;
}

function checkChunk(name: string, key: string, chunk: Uint8Array, count: number, { format, length }: Records): void {
  const { bytes, colors } = FORMATS[format]!;
  // Each extra byte of a point has its own layer.
  const layers = LAYERS + colors + length - bytes;
  const head = length + 4 + 4 * layers;
  if (chunk.length < head) {
    throw broken(name, `node ${key} has ${chunk.length} bytes, too few for a chunk of points`);
  }
  const view = new DataView(chunk.buffer, chunk.byteOffset, chunk.byteLength);
  const own = view.getUint32(length, true);
  if (own !== count) {
    throw broken(name, `node ${key} is listed with ${count} points, but holds ${own}`);
  }
  let end = head;
  for (let layer = 0; layer < layers; layer++) end += view.getUint32(length + 4 + 4 * layer, true);
  if (end !== chunk.length) {
    throw broken(name, `node ${key} is listed with ${chunk.length} bytes, but holds ${end}`);
  }
}
