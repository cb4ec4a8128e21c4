// A cloud in parts that need not be in memory together. The answer is that of the whole cloud.
import { init, hiddenPointRemoval, mergeVisible } from "hidden-point-removal";

await init();
const viewpoint = [0, 0, 5];
const options = { radius: 100 }; // the same for every part, so it is a number

/** The points of a sphere from `from` to `to`. */
function load(from, to) {
  return Array.from({ length: to - from }, (_, i) => {
    const z = 1 - (2 * (from + i) + 1) / 20_000;
    const r = Math.sqrt(1 - z * z);
    const turn = 2.399963 * (from + i);
    return [r * Math.cos(turn), r * Math.sin(turn), z];
  });
}

const parts = [0, 5000, 10_000, 15_000].map((from) => {
  const points = load(from, from + 5000);
  // Only what is visible in its part can be visible in the whole.
  const { indices } = hiddenPointRemoval(points.flat(), viewpoint, options);
  return { positions: [...indices].flatMap((i) => points[i]), ids: indices.map((i) => from + i) };
});
const merged = mergeVisible(parts, viewpoint, options);
const whole = hiddenPointRemoval(load(0, 20_000).flat(), viewpoint, options).indices;
console.log(
  merged.length === whole.length,
  merged.every((id, i) => id === whole[i]),
); // → true true
