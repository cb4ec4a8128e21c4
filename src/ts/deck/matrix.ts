import { HprError } from "../base/errors.js";

/** 16 numbers by columns, as deck.gl's `modelMatrix`. */
export type Matrix = ArrayLike<number>;

/** How far the axes may be from the same length and from right angles. */
const TOLERANCE = 1e-5;

export function applied(m: Matrix, [x = 0, y = 0, z = 0]: ArrayLike<number> & Iterable<number>): number[] {
  return [0, 1, 2].map((row) => m[row]! * x + m[4 + row]! * y + m[8 + row]! * z + m[12 + row]!);
}

/**
 * The inverse of {@link applied} for a point, or for a direction, which does not heed the translation.
 *
 * @throws HprError `option` if the matrix changes shapes: then no viewpoint in the data sees what is drawn.
 */
export function unapplied(m: Matrix, to: readonly number[], isDirection: boolean): number[] {
  const axes = [0, 4, 8].map((at) => [m[at]!, m[at + 1]!, m[at + 2]!]);
  const dot = (a: readonly number[], b: readonly number[]) => a[0]! * b[0]! + a[1]! * b[1]! + a[2]! * b[2]!;
  const square = dot(axes[0]!, axes[0]!);
  const isSimilar = axes.every((a, i) =>
    axes.every((b, j) => Math.abs(dot(a, b) - (i === j ? square : 0)) <= TOLERANCE * square),
  );
  const isAffine = m[3] === 0 && m[7] === 0 && m[11] === 0 && m[15] === 1;
  if (!(square > 0 && Number.isFinite(square) && isSimilar && isAffine)) {
    throw new HprError(
      "option",
      "modelMatrix scales the axes differently or is no affine matrix: what the camera sees cannot be computed in the " +
        "data's coordinates. Scale all axes alike, apply the matrix to the positions, or give viewpoint",
    );
  }
  const rest = isDirection ? to : to.map((x, axis) => x - m[12 + axis]!);
  return axes.map((axis) => dot(axis, rest) / square);
}
