import type { Contradictions } from "../contradictions.js";
import { type ChunkLayout, decodeChunk, type LazPerf } from "./laz-perf.js";
import type { ChunkParts } from "./laz.js";

/** More bytes than the decoder reads ahead, or than a writer adds at the end. */
const AHEAD = 16;
/** The layers that hold coordinates: x and y, and z. A chunk of the older formats is one layer. */
const OF_POSITIONS = 2;

/**
 * Decompresses the last chunk of a file, whose number of points comes from the header, and looks whether its bytes are used up.
 * With other bytes behind each layer, no point may change: points that do are not in the chunk. With other bytes at the end
 * of a layer, a point must change, or the chunk holds more. Returns the number of points that are there.
 */
export function checkTail(
  perf: LazPerf,
  chunk: Uint8Array,
  { points, at }: ChunkParts,
  layout: ChunkLayout,
  found: Contradictions,
): number {
  const rows = (edit: Edit) => rowsOf(perf, rebuilt(chunk, at, layout, edit), points, layout);
  const right = rows((layer) => followed(layer, 0));
  const same = sameRows(right, rows((layer) => followed(layer, 255)), layout.rowBytes); // prettier-ignore
  if (same < points) {
    found.add(`its last chunk does not hold the ${points} points that are promised, but ${same}`);
    return same;
  }
  for (let i = 0; i < at.length - 1 && i < OF_POSITIONS; i++) {
    if (at[i + 1]! - at[i]! <= 2 * AHEAD) continue;
    const changed = rows((layer, which) => followed(which === i ? layer.map(inverted) : layer, 0));
    if (sameRows(right, changed, layout.rowBytes) === points) {
      found.add(`its last chunk holds more than the ${points} points that are promised`);
    }
  }
  return points;
}

type Edit = (layer: Uint8Array, which: number) => Uint8Array;

function inverted(byte: number, i: number, layer: Uint8Array): number {
  return i < layer.length - AHEAD ? byte : 255 - byte;
}

function followed(layer: Uint8Array, byte: number): Uint8Array {
  const longer = new Uint8Array(layer.length + AHEAD).fill(byte);
  longer.set(layer);
  return longer;
}

/** The chunk with other layers of coordinates. */
function rebuilt(chunk: Uint8Array, at: readonly number[], { rowBytes }: ChunkLayout, edit: Edit): Uint8Array {
  const head = chunk.slice(0, at[0]);
  const layers = at.slice(0, -1).map((start, i) => {
    const layer = chunk.subarray(start, at[i + 1]);
    // An empty layer says that its numbers never change.
    return i < OF_POSITIONS && layer.length > 0 ? edit(layer, i) : layer;
  });
  const sizes = new DataView(head.buffer, rowBytes);
  if (layers.length > 1) {
    layers.forEach(({ length }, i) => {
      sizes.setUint32(4 + 4 * i, length, true);
    });
  }
  const all = new Uint8Array(layers.reduce((sum, { length }) => sum + length, head.length));
  all.set(head);
  layers.reduce((place, layer) => {
    all.set(layer, place);
    return place + layer.length;
  }, head.length);
  return all;
}

function rowsOf(perf: LazPerf, chunk: Uint8Array, count: number, layout: ChunkLayout): Uint8Array {
  const rows = new Uint8Array(count * layout.rowBytes);
  let at = 0;
  decodeChunk(perf, chunk, count, layout, (view, from) => {
    rows.set(new Uint8Array(view.buffer, view.byteOffset + from, layout.rowBytes), at);
    at += layout.rowBytes;
  });
  return rows;
}

/** The number of rows at the beginning that are the same. */
function sameRows(a: Uint8Array, b: Uint8Array, rowBytes: number): number {
  const first = a.findIndex((value, i) => value !== b[i]);
  return Math.floor((first < 0 ? a.length : first) / rowBytes);
}
