// How well scores from 0 to 1 serve as probabilities.

const BINS = 20;

/**
 * Sorts the points into bins by score. The error of a bin is the difference between its share of visible points and its
 * mean score. Returns the mean of this error over all points.
 */
export function calibrationError(scores: Float64Array, labels: Uint8Array): number {
  const bins = Array.from({ length: BINS }, () => ({ score: 0, visible: 0 }));
  scores.forEach((score, i) => {
    const bin = bins[Math.min(Math.floor(score * BINS), BINS - 1)]!;
    bin.score += score;
    bin.visible += labels[i]!;
  });
  return bins.reduce((sum, { score, visible }) => sum + Math.abs(score - visible), 0) / scores.length;
}

/** How often a visible point has a higher score than a hidden point: the area under the ROC curve. Equal scores count half. */
export function rankedRight(scores: Float64Array, labels: Uint8Array): number {
  const order = Uint32Array.from(scores.keys()).sort((a, b) => scores[a]! - scores[b]!);
  let [pairs, hiddenBefore] = [0, 0];
  for (let start = 0; start < order.length;) {
    let end = start;
    let visible = 0;
    while (end < order.length && scores[order[end]!] === scores[order[start]!]) visible += labels[order[end++]!]!;
    const hidden = end - start - visible;
    pairs += visible * (hiddenBefore + hidden / 2);
    hiddenBefore += hidden;
    start = end;
  }
  return pairs / (hiddenBefore * (order.length - hiddenBefore));
}
