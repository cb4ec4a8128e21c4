/** Points as a file that the page opens. `brightness` from 0 to 1 becomes shades of gray. */
export function pointPly(positions: Float32Array | Float64Array, brightness?: Float32Array): Uint8Array {
  const count = positions.length / 3;
  const colors = brightness === undefined ? [] : ["red", "green", "blue"].map((name) => `property uchar ${name}`);
  const axes = ["x", "y", "z"].map((name) => `property float ${name}`);
  const header = [
    "ply",
    "format binary_little_endian 1.0",
    `element vertex ${count}`,
    ...axes,
    ...colors,
    "end_header",
    "",
  ];
  const start = Buffer.from(header.join("\n"));
  const stride = 12 + colors.length;
  const body = Buffer.alloc(stride * count);
  for (let i = 0; i < count; i++) {
    for (let axis = 0; axis < 3; axis++) body.writeFloatLE(positions[3 * i + axis]!, stride * i + 4 * axis);
    if (brightness !== undefined) body.fill(Math.round(255 * brightness[i]!), stride * i + 12, stride * (i + 1));
  }
  return Buffer.concat([start, body]);
}
