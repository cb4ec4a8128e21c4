/** The box around the points, and how many points have no position. */
export interface Box {
  low: [number, number, number];
  high: [number, number, number];
  /** The number of points with a NaN or infinite coordinate. `firstStray` is the first of them, or -1. */
  strays: number;
  firstStray: number;
}

/** The box around these points: x, y, z of one point after another. */
export function boxOf(numbers: Float32Array | Float64Array): Box {
  const box: Box = {
    low: [Infinity, Infinity, Infinity],
    high: [-Infinity, -Infinity, -Infinity],
    strays: 0,
    firstStray: -1,
  };
  const { low, high } = box;
  for (let i = 0; i < numbers.length; i += 3) {
    const [x, y, z] = [numbers[i]!, numbers[i + 1]!, numbers[i + 2]!];
    if (!(Number.isFinite(x) && Number.isFinite(y) && Number.isFinite(z))) {
      if (box.strays++ === 0) box.firstStray = i / 3;
      continue;
    }
    if (x < low[0]) low[0] = x;
    if (x > high[0]) high[0] = x;
    if (y < low[1]) low[1] = y;
    if (y > high[1]) high[1] = y;
    if (z < low[2]) low[2] = z;
    if (z > high[2]) high[2] = z;
  }
  return box;
}

/** The longest side of the box around all points. */
export function extentOf(boxes: Iterable<Box>): number {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (const box of boxes) {
    for (let axis = 0; axis < 3; axis++) {
      low[axis] = Math.min(low[axis]!, box.low[axis]!);
      high[axis] = Math.max(high[axis]!, box.high[axis]!);
    }
  }
  const extent = Math.max(...high.map((x, axis) => x - low[axis]!));
  return Number.isFinite(extent) ? extent : 0;
}
