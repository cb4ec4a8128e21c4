import { PerspectiveCamera } from "three";
import { expect, it } from "vitest";

import { bumpySphere, expectRefusal, randomNumbers, readyPackage } from "./support";

const { PointCloud, WorkerPointCloud, cameraFromThree, orientNormals } = await readyPackage();

// Far from the origin: single precision would lose the directions.
const positions = Float64Array.from(bumpySphere(5, 3000), (x, i) => x + 1e7 * (1 + (i % 3)));
const center = [1e7, 2e7, 3e7];
const places = [0, 1, 2, 3, 4].map((i) =>
  [3 * Math.cos(i), 3 * Math.sin(i), i - 2].map((x, axis) => x + center[axis]!),
);
const cameras = places.map((place) => {
  const three = new PerspectiveCamera(45, 4 / 3, 0.1, 100);
  three.position.fromArray(place);
  three.lookAt(...(center as [number, number, number]));
  return cameraFromThree(three, 640, 480);
});

/** Directions by chance: for many of them, the cameras do not agree. */
function randomNormals(): Float64Array<ArrayBuffer> {
  const random = randomNumbers(3);
  return Float64Array.from(positions, () => 2 * random() - 1);
}

it("most of the cameras that see a point look at its normal from outside", async () => {
  const cloud = new PointCloud(positions);
  const seenBy = cloud.seenBy(cameras, { looks: 3 });
  const normals = randomNormals();
  const before = normals.slice();
  const oriented = orientNormals(normals, seenBy);
  expect(normals).toEqual(before);
  const counts = { turned: 0, unseen: 0, ties: 0, split: 0 };
  for (let i = 0; i < cloud.length; i++) {
    const numbers = [...seenBy.cameras.subarray(seenBy.offsets[i], seenBy.offsets[i + 1])];
    const cosines = numbers.map((number) => {
      const v = [0, 1, 2].map((axis) => places[number]![axis]! - positions[3 * i + axis]!);
      return v.reduce((sum, x, axis) => sum + x * normals[3 * i + axis]!, 0) / Math.hypot(...v);
    });
    const behind = cosines.filter((cosine) => cosine < 0).length;
    const isTurned =
      2 * behind === numbers.length ? cosines.reduce((a, b) => a + b, 0) < 0 : 2 * behind > numbers.length;
    expect([...oriented.subarray(3 * i, 3 * i + 3)]).toEqual(
      [...normals.subarray(3 * i, 3 * i + 3)].map((x) => (isTurned ? -x : x)),
    );
    counts.turned += Number(isTurned);
    counts.unseen += Number(numbers.length === 0);
    counts.ties += Number(numbers.length > 0 && 2 * behind === numbers.length);
    counts.split += Number(behind > 0 && behind < numbers.length);
  }
  for (const count of Object.values(counts)) expect(count).toBeGreaterThan(50);
  const single = orientNormals(Float32Array.from(normals), seenBy);
  expect(single).toEqual(Float32Array.from(oriented));
  for (const workers of [1, 2]) {
    const remote = await WorkerPointCloud.create(positions, { workers });
    expect(orientNormals(normals, await remote.seenBy(cameras, { looks: 3 }))).toEqual(oriented);
    await remote.dispose();
  }
  cloud.dispose();
});

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
