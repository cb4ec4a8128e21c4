import type { Transferred } from "../query/transfer.js";

/** How many points are made into one piece. */
const PIECE = 65_536;

/**
 * A binary PLY file of all points in their order, each with its color, or its value if there is one channel, and with the
 * number of cameras that see it. What no camera sees is black, or NaN, and its `seen` is 0.
 */
export function* coloredPly(
  positions: Float32Array | Float64Array,
  { values, channels, seen }: Transferred,
): Generator<Uint8Array> {
  const isColor = channels >= 3;
  const size = positions.BYTES_PER_ELEMENT;
  const type = size === 4 ? "float" : "double";
  const names = isColor ? ["uchar red", "uchar green", "uchar blue"] : ["float value"];
  const properties = [...["x", "y", "z"].map((axis) => `${type} ${axis}`), ...names, "uint seen"];
  const lines = properties.map((property) => `property ${property}\n`).join("");
  yield Buffer.from(`ply\nformat binary_little_endian 1.0\nelement vertex ${seen.length}\n${lines}end_header\n`);
  const width = 3 * size + (isColor ? 3 : 4) + 4;
  for (let first = 0; first < seen.length; first += PIECE) {
    const count = Math.min(PIECE, seen.length - first);
    const piece = new DataView(new ArrayBuffer(count * width));
    for (let k = 0; k < count; k++) {
      const i = first + k;
      let at = k * width;
      for (let axis = 0; axis < 3; axis++, at += size) {
        if (size === 4) piece.setFloat32(at, positions[3 * i + axis]!, true);
        else piece.setFloat64(at, positions[3 * i + axis]!, true);
      }
      if (isColor) {
        for (let c = 0; c < 3; c++) piece.setUint8(at++, Math.round(values[i * channels + c]! || 0));
      } else {
        piece.setFloat32(at, values[i * channels]!, true);
        at += 4;
      }
      piece.setUint32(at, seen[i]!, true);
    }
    yield new Uint8Array(piece.buffer);
  }
}
