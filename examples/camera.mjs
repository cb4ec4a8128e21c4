// What a camera with a known pose sees, and how many cameras see each point.
import { cameraFromPose, init, PointCloud } from "hidden-point-removal";

await init();
// A wall of 40 by 40 points, and a smaller one 2 before it.
const wall = (n, z) => Array.from({ length: n * n }, (_, i) => [(i % n) / 10, Math.floor(i / n) / 10, z]);
const positions = [...wall(40, 0), ...wall(20, 2)].flat();
const cloud = new PointCloud(positions);

const lens = { fx: 500, fy: 500, cx: 320, cy: 240, width: 640, height: 480 };
// A quaternion x, y, z, w: half a turn about x, so that the camera looks along -z.
const camera = cameraFromPose([2, 2, 10], [1, 0, 0, 0], lens);
const { indices, pixels, depths } = cloud.visibleFromCamera(camera);
const last = indices.length - 1;
console.log(indices.length < cloud.length); // → true
console.log(pixels.length === 2 * indices.length, depths[last].toFixed(1)); // → true 8.0

// The corner of the wall that the smaller one hides from the first place is seen from the second.
const seen = cloud.coverage([[2, 2, 10], [-8, 2, 10]]); // prettier-ignore
const counts = [0, 1, 2].map((n) => seen.filter((count) => count === n).length);
console.log(counts[2] > counts[1], counts.reduce((sum, n) => sum + n) === cloud.length); // → true true
cloud.dispose();
