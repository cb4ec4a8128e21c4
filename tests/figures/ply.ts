/** Points as a file that the page opens. */
export function pointPly(positions: Float32Array | Float64Array): Uint8Array {
  const count = positions.length / 3;
  const axes = ["x", "y", "z"].map((name) => `property float ${name}`);
  const header = ["ply", "format binary_little_endian 1.0", `element vertex ${count}`, ...axes, "end_header", ""];
  // The computer that draws figures is little-endian, as are all that run Chromium.
  return Buffer.concat([Buffer.from(header.join("\n")), new Uint8Array(Float32Array.from(positions).buffer)]);
}
