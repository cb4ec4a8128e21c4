/** Points in numbers: how many, where, and how far from one another. */
export interface Measure {
  count: number;
  low: [number, number, number];
  high: [number, number, number];
  mean: [number, number, number];
  /** Mean square distance from the mean. */
  variance: number;
}

/** Of x, y, z of one point after another; those that are not finite take no part. */
export function measure(numbers: Float32Array | Float64Array): Measure {
  const low: Measure["low"] = [Infinity, Infinity, Infinity];
  const high: Measure["high"] = [-Infinity, -Infinity, -Infinity];
  const mean: Measure["mean"] = [0, 0, 0];
  let count = 0;
  let sum = 0;
  for (let i = 0; i < numbers.length; i += 3) {
    if (!Number.isFinite(numbers[i]! + numbers[i + 1]! + numbers[i + 2]!)) {
      continue;
    }
    count += 1;
    for (let axis = 0; axis < 3; axis++) {
      const x = numbers[i + axis]!;
      if (x < low[axis]!) low[axis] = x;
      if (x > high[axis]!) high[axis] = x;
      // Welford's: far from the origin, sums of squares would lose everything.
      const off = x - mean[axis]!;
      mean[axis]! += off / count;
      sum += off * (x - mean[axis]!);
    }
  }
  return { count, low, high, mean, variance: count === 0 ? 0 : sum / count };
}

/** Mean square distance of all points from a viewpoint. */
export function meanSquare(measures: readonly Measure[], viewpoint: readonly number[]): number {
  let [count, sum] = [0, 0];
  for (const { count: points, mean, variance } of measures) {
    const distance = Math.hypot(mean[0] - viewpoint[0]!, mean[1] - viewpoint[1]!, mean[2] - viewpoint[2]!);
    sum += points * (distance ** 2 + variance);
    count += points;
  }
  return count === 0 ? 0 : sum / count;
}

/** No point is farther from a viewpoint than the farthest corner of a box, by a little more than rounding. */
export function farthest(measures: readonly Measure[], viewpoint: readonly number[]): number {
  let distance = 0;
  for (const { count, low, high } of measures) {
    if (count > 0) {
      const reach = [0, 1, 2].map((axis) => Math.max(Math.abs(low[axis]! - viewpoint[axis]!), Math.abs(high[axis]! - viewpoint[axis]!)));
      distance = Math.max(distance, Math.hypot(...reach));
    }
  }
  return distance * (1 + 1e-12);
}

/** The longest side of the box around all. */
export function extent(measures: readonly Measure[]): number {
  const filled = measures.filter(({ count }) => count > 0);
  const sides = [0, 1, 2].map((axis) => Math.max(...filled.map(({ high }) => high[axis]!)) - Math.min(...filled.map(({ low }) => low[axis]!)));
  return filled.length === 0 ? 0 : Math.max(...sides);
}
