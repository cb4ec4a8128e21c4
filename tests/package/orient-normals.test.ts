import { expect, it } from "vitest";

import { expectRefusal, readyPackage } from "./support";

const { PointCloud, orientNormals } = await readyPackage();

it("normals and rows that do not fit are refused", async () => {
  const cloud = new PointCloud([0, 0, 1, 0, 0, 2]);
  const good = cloud.seenBy([]);
  expect(orientNormals(Float32Array.of(1, 2, 3, 4, 5, 6), good)).toEqual(Float32Array.of(1, 2, 3, 4, 5, 6));
  const gone = new Float32Array(6);
  structuredClone(gone.buffer, { transfer: [gone.buffer] });
  const one = { offsets: Uint32Array.of(0, 1, 1), towards: Float32Array.of(0, 0, 1) };
  expect(orientNormals(Float32Array.of(0, 0, -1, 0, NaN, 0), one)).toEqual(Float32Array.of(-0, -0, 1, 0, NaN, 0));
  const bad: [unknown, unknown, RegExp][] = [
    [[1, 2, 3, 4, 5, 6], good, /normals must be a Float32Array or a Float64Array/],
    [new Int8Array(6), good, /normals must be/],
    [gone, good, /not transferred away/],
    [new Float32Array(5), good, /three numbers for each of 2 indices, got 5/],
    [new Float32Array(9), good, /got 9/],
    [new Float32Array(6), undefined, /seenBy must be what seenBy/],
    [new Float32Array(6), { ...good, offsets: [0, 0, 0] }, /seenBy must be/],
    [new Float32Array(6), { ...one, offsets: Uint32Array.of(0, 2, 1) }, /seenBy must be/],
    [new Float32Array(6), { ...one, towards: new Float32Array(2) }, /seenBy must be/],
    [new Float32Array(6), { offsets: new Uint32Array(0), towards: new Float32Array(0) }, /seenBy must be/],
  ];
  for (const [normals, seenBy, message] of bad) {
    await expectRefusal("option", message, () => orientNormals(normals as never, seenBy as never));
  }
  cloud.dispose();
});
