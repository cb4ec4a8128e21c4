import { type ChunkLayout, decodeChunk, type LazPerf } from "../formats/laz-perf.js";
import { broken } from "./source.js";

/** The place of red, green and blue in a point of format 7 or 8. */
const COLORS_AT = 30;

/** The point formats of COPC: their number of bytes, and the layers of their colors. */
const FORMATS: Partial<Record<number, { bytes: number; colors: number }>> = {
  6: { bytes: 30, colors: 0 },
  7: { bytes: 36, colors: 1 },
  8: { bytes: 38, colors: 2 },
};

/** The layers of x and y, z, class, flags, intensity, angle, user data, source and time. */
const LAYERS = 9;

export function checkRecords(name: string, { format, rowBytes }: ChunkLayout): void {
  const layout = FORMATS[format];
  if (layout === undefined || rowBytes < layout.bytes) {
    throw broken(name, `COPC has points of format 6, 7 or 8, but these have format ${format} and ${rowBytes} bytes`);
  }
}

export function hasColors({ format }: ChunkLayout): boolean {
  return FORMATS[format]!.colors > 0;
}

/**
 * Decompresses the coordinates of one chunk of points: x, y, z as integers. If there is an array for colors, red, green and
 * blue of each point are written to it.
 *
 * A chunk holds its first point, the number of its points, the size of each layer, and the layers.
 * These are checked first, since the decoder itself reads on beyond the end.
 */
export function decompress(
  name: string,
  key: string,
  chunk: Uint8Array,
  count: number,
  layout: ChunkLayout,
  perf: LazPerf,
  colors?: Uint16Array,
): Int32Array {
  checkChunk(name, key, chunk, count, layout);
  const integers = new Int32Array(3 * count);
  let at = 0;
  try {
    decodeChunk(perf, chunk, count, layout, (point) => {
      for (let axis = 0; axis < 3; axis++, at++) {
        integers[at] = point.getInt32(4 * axis, true);
        if (colors) colors[at] = point.getUint16(COLORS_AT + 2 * axis, true);
      }
    });
  } catch (cause) {
    throw broken(name, `the points of node ${key} cannot be decompressed`, cause);
  }
  return integers;
}

function checkChunk(
  name: string,
  key: string,
  chunk: Uint8Array,
  count: number,
  { format, rowBytes }: ChunkLayout,
): void {
  const { bytes, colors } = FORMATS[format]!;
  // Each extra byte of a point has its own layer.
  const layers = LAYERS + colors + rowBytes - bytes;
  const head = rowBytes + 4 + 4 * layers;
  if (chunk.length < head) {
    throw broken(name, `node ${key} has ${chunk.length} bytes, too few for a chunk of points`);
  }
  const view = new DataView(chunk.buffer, chunk.byteOffset, chunk.byteLength);
  const own = view.getUint32(rowBytes, true);
  if (own !== count) {
    throw broken(name, `node ${key} is listed with ${count} points, but holds ${own}`);
  }
  let end = head;
  for (let layer = 0; layer < layers; layer++) end += view.getUint32(rowBytes + 4 + 4 * layer, true);
  if (end !== chunk.length) {
    throw broken(name, `node ${key} is listed with ${chunk.length} bytes, but holds ${end}`);
  }
}
