/** How many points have a NaN or infinite coordinate, and the number of the first of them, or -1. */
export function straysIn(numbers: Float32Array | Float64Array): { count: number; first: number } {
  const strays = { count: 0, first: -1 };
  for (let i = 0; i < numbers.length; i += 3) {
    if (!(Number.isFinite(numbers[i]) && Number.isFinite(numbers[i + 1]) && Number.isFinite(numbers[i + 2]))) {
      if (strays.count++ === 0) strays.first = i / 3;
    }
  }
  return strays;
}
