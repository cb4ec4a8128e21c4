/** The viewpoint of a view, or the direction that it looks along. */
export interface Place {
  readonly from: readonly number[];
  readonly isDirection: boolean;
}

/** A shorter move, as a share of the cloud's spacing, cannot be seen. */
const MOVE = 1e-3;
/** The same for a direction of length 1. */
const TURN = 1e-6;

/**
 * Whether an answer for `a` need not be asked again for `b`. NaN is equal to NaN, so that it is refused only once. `rounding`:
 * how far rounding alone may move a viewpoint.
 */
export function isNear(a: Place, b: Place, spacing: number, rounding = 0): boolean {
  if (a.isDirection !== b.isDirection || a.from.length !== b.from.length) {
    return false;
  }
  const blur = (a.isDirection ? TURN * Math.hypot(...a.from) : MOVE * spacing) + rounding;
  const farthest = Number.isFinite(blur) ? blur : 0;
  return a.from.every((x, axis) => Math.abs(x - b.from[axis]!) <= farthest || Object.is(x, b.from[axis]));
}

/** The cosine of the largest angle between two places, seen from the center, at which one may stand in for the other. */
const STAND_IN = Math.cos((2 * Math.PI) / 180);

/** Whether a picture from `a` is too different to be shown at `b`. */
export function isFarFrom(a: Place, b: Place, center: readonly number[]): boolean {
  const [p, q] = [a, b].map(({ from }) => from.map((x, axis) => x - center[axis]!)) as [number[], number[]];
  const cosine = p.reduce((sum, x, axis) => sum + x * q[axis]!, 0) / (Math.hypot(...p) * Math.hypot(...q));
  return a.isDirection !== b.isDirection || cosine < STAND_IN;
}
