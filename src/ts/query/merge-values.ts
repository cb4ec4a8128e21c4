export const MERGES = ["median", "mean", "vote", "best"] as const;
/** How the values of several cameras become one. */
export type Merge = (typeof MERGES)[number];

/** Merges the first `count` rows. */
export function merged(
  merge: Merge,
  rows: readonly Float64Array[],
  weights: Float64Array,
  count: number,
  target: Float64Array,
): void {
  if (merge === "best") {
    target.set(rows[highest(weights, count)]!);
  } else if (merge === "vote") {
    target.set(rows[elected(rows, weights, count)]!);
  } else {
    const average = merge === "mean" ? mean : median;
    for (let c = 0; c < target.length; c++) {
      target[c] = average(rows, weights, count, c);
    }
  }
}

/** The first of the highest weights. */
function highest(weights: Float64Array, count: number): number {
  let best = 0;
  for (let i = 1; i < count; i++) if (weights[i]! > weights[best]!) best = i;
  return best;
}

/** The first row whose equals have the highest weight together. */
function elected(rows: readonly Float64Array[], weights: Float64Array, count: number): number {
  const votes = new Float64Array(count);
  for (let i = 0; i < count; i++) {
    const same = rows.findIndex((row) => row.every((value, c) => value === rows[i]![c]));
    votes[same]! += weights[i]!;
  }
  return highest(votes, count);
}

function mean(rows: readonly Float64Array[], weights: Float64Array, count: number, channel: number): number {
  let [sum, total] = [0, 0];
  for (let i = 0; i < count; i++) {
    sum += weights[i]! * rows[i]![channel]!;
    total += weights[i]!;
  }
  // All scores may be 0.
  return total > 0 ? sum / total : rows[0]![channel]!;
}

/** The value at which half of the weight is reached; between two values if it is reached exactly there. */
function median(rows: readonly Float64Array[], weights: Float64Array, count: number, channel: number): number {
  const order = Array.from({ length: count }, (_, i) => i).sort((a, b) => rows[a]![channel]! - rows[b]![channel]!);
  const half = order.reduce((sum, i) => sum + weights[i]!, 0) / 2;
  let sum = 0;
  for (const [k, i] of order.entries()) {
    sum += weights[i]!;
    if (sum > half || k === count - 1) return rows[i]![channel]!;
    if (sum === half) return (rows[i]![channel]! + rows[order[k + 1]!]![channel]!) / 2;
  }
  return NaN;
}
