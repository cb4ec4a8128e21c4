// Which points of a sphere can be seen from above?
import { init, PointCloud } from "hidden-point-removal";

await init();
const positions = new Float32Array(30_000); // x, y, z of 10,000 points
for (let i = 0; i < 10_000; i++) {
  const z = 1 - (2 * i + 1) / 10_000;
  const r = Math.sqrt(1 - z * z);
  const turn = 2.399963 * i;
  positions.set([r * Math.cos(turn), r * Math.sin(turn), z], 3 * i);
}

const cloud = new PointCloud(positions);
const { indices, count, radius } = cloud.visibleFrom([0, 0, 5]);
console.log(`${count} points, the first is ${indices[0]}, R > 5: ${radius > 5}`); // → 4118 points, the first is 0, R > 5: true

// Without the core, a point is visible or hidden by its index.
const mask = cloud.visibleFrom([0, 0, -5]).mask();
console.log(mask[0], mask[9_999]); // → 0 1
cloud.dispose();
