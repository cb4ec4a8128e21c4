/** The share of values at either end that may be strays, and the number of values that are looked at. */
const STRAYS = 0.01;
const SAMPLE = 5000;

/** Finds two values that have nearly all other values between them. Only finite values count. */
export function spreadOf(count: number, value: (i: number) => number, strays = STRAYS): [low: number, high: number] {
  const step = Math.ceil(count / SAMPLE);
  const sample = new Float64Array(Math.ceil(count / step));
  let finite = 0;
  for (let i = 0; i < count; i += step) {
    const one = value(i);
    if (Number.isFinite(one)) sample[finite++] = one;
  }
  const sorted = sample.subarray(0, finite).sort();
  const at = (share: number) => sorted[Math.round(share * (finite - 1))] ?? 0;
  return [at(strays), at(1 - strays)];
}
