// The operator alone, in a small wasm. The same points as from the main entry, to the bit.
import { HprError, init, PointCloud } from "hidden-point-removal/lite";

await init();
const positions = new Float32Array(30_000); // x, y, z of 10,000 points on a sphere
for (let i = 0; i < 10_000; i++) {
  const z = 1 - (2 * i + 1) / 10_000;
  const r = Math.sqrt(1 - z * z);
  const turn = 2.399963 * i;
  positions.set([r * Math.cos(turn), r * Math.sin(turn), z], 3 * i);
}

const cloud = new PointCloud(positions);
console.log(cloud.visibleFrom([0, 0, 5]).count); // → 4118
console.log(cloud.visibleFrom([0, 0, 5], { inversion: { exponential: "auto" } }).count > 4000); // → true

cloud.append([0, 0, 2]); // hides what is behind it
cloud.remove([0]);
console.log(cloud.visibleFrom([0, 0, 5]).mask()[10_000]); // → 1

try {
  cloud.visibleFrom([0, 0, 5], { looks: 3 }); // only in the main entry
} catch (error) {
  console.log(error instanceof HprError && error.code); // → option
}
cloud.dispose();
