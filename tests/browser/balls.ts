import { bumpySurface } from "../bench/generators.js";
import { binaryPly } from "./clouds.js";

/** The middles of four bumpy balls of radius 1. The first one hides parts of the others. */
const MIDDLES = [
  [0, 0, 2.2],
  [-1.6, 0.9, 0],
  [1.7, 0.7, -0.4],
  [0.1, -1.1, -0.8],
];

/** The balls as a binary PLY file. `count`: the number of their points together. */
export function fourBalls(count: number): Uint8Array {
  const each = Math.floor(count / MIDDLES.length);
  const positions = new Float32Array(3 * each * MIDDLES.length);
  MIDDLES.forEach((middle, i) => {
    const surface = bumpySurface(each, i + 1);
    for (let k = 0; k < surface.length; k++) positions[3 * each * i + k] = surface[k]! + middle[k % 3]!;
  });
  return binaryPly(positions, "float", true);
}
