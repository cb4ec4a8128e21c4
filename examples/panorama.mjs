// What stands in each direction around a place: how far it is, which point it is, and how much sky is left.
import { init, PointCloud } from "hidden-point-removal";

await init();
// A yard of 8 by 8 with walls 4 high, seen from its middle at a height of 1.6.
const steps = Array.from({ length: 81 }, (_, i) => i / 10 - 4);
const ground = steps.flatMap((x) => steps.map((y) => [x, y, 0]));
const heights = steps.filter((z) => z >= 0);
const walls = steps.flatMap((t) => heights.flatMap((z) => [[t, -4, z], [t, 4, z], [-4, t, z], [4, t, z]])); // prettier-ignore
const cloud = new PointCloud([...ground, ...walls].flat());

// Row 0 is up, column 0 looks along +x.
const [width, height] = [64, 32];
const { ranges, indices, skyViewFactor, solidAngle } = cloud.panorama([0, 0, 1.6], { width, height, looks: 3 });
console.log(skyViewFactor.toFixed(2), (solidAngle / (4 * Math.PI)).toFixed(2)); // → 0.77 0.74

const eighths = Array.from({ length: 8 }, (_, i) => (width / 8) * i + (height / 2) * width);
console.log(eighths.map((pixel) => ranges[pixel].toFixed(1)).join(" ")); // → 4.0 5.7 4.0 5.7 4.0 5.7 4.0 5.7
console.log(ranges[0], indices[0] === 2 ** 32 - 1); // → Infinity true
cloud.dispose();
