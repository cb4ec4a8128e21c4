import { plyParts } from "../formats/write/ply.js";
import type { Transferred } from "../query/transfer.js";

/**
 * A binary PLY file of all points in their order, each with its color, or its value if there is one channel, and with the
 * number of cameras that see it. What no camera sees is black, or NaN, and its `seen` is 0.
 */
export function coloredPly(
  positions: Float32Array | Float64Array,
  { values, channels, seen }: Transferred,
): Iterable<Uint8Array> {
  const isColor = channels >= 3;
  return plyParts({
    positions,
    colors: isColor
      ? new Uint8Array(3 * seen.length).map((_, i) => Math.round(values[channels * Math.floor(i / 3) + (i % 3)]! || 0))
      : null,
    fields: [...(isColor ? [] : [{ name: "value", values }]), { name: "seen", values: seen }],
    indices: new Uint32Array(seen.length).map((_, i) => i),
  });
}
