import type { ChunkLayout, LazDecoder } from "../formats/las/laz.js";
import { broken } from "./source.js";

/** The place of red, green and blue in a point of format 7 or 8. */
const COLORS_AT = 30;

/** The point formats of COPC, and their number of bytes. */
const FORMATS: Partial<Record<number, number>> = { 6: 30, 7: 36, 8: 38 };

export function checkRecords(name: string, { format, rowBytes }: ChunkLayout): void {
  const least = FORMATS[format];
  if (least === undefined || rowBytes < least) {
    throw broken(name, `COPC has points of format 6, 7 or 8, but these have format ${format} and ${rowBytes} bytes`);
  }
}

export function hasColors({ format }: ChunkLayout): boolean {
  return format > 6;
}

/**
 * Decompresses the coordinates of one chunk of points: x, y, z as integers. If there is an array for colors, red, green and
 * blue of each point are written to it.
 */
export function decompress(
  name: string,
  key: string,
  chunk: Uint8Array,
  count: number,
  decoder: LazDecoder,
  colors?: Uint16Array,
): Int32Array {
  const integers = new Int32Array(3 * count);
  let at = 0;
  const says = decoder.decode(chunk, count, (point, from) => {
    for (let axis = 0; axis < 3; axis++, at++) {
      integers[at] = point.getInt32(from + 4 * axis, true);
      if (colors) colors[at] = point.getUint16(from + COLORS_AT + 2 * axis, true);
    }
  });
  if (says !== undefined) throw broken(name, `node ${key} ${says}`);
  return integers;
}
