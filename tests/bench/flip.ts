// The flipped points (paper, eq. 1). Every peer builds its hull of them. They follow the
// fixed sequence of operations for which the library's answers are exact.
import type { Point } from "./measure.js";

/** x, y, z of each flipped point. No point may be at the viewpoint. */
export function flip(positions: Float32Array | Float64Array, [cx, cy, cz]: Point, radius: number): Float64Array {
  const q = new Float64Array(positions.length);
  for (let i = 0; i < q.length; i += 3) {
    const x = positions[i]! - cx;
    const y = positions[i + 1]! - cy;
    const z = positions[i + 2]! - cz;
    const d = Math.sqrt(x * x + y * y + z * z);
    const s = (2 * radius - d) / d;
    q[i] = x * s;
    q[i + 1] = y * s;
    q[i + 2] = z * s;
  }
  return q;
}
