// The law of units: a question to a cloud in other units has the same answer, to the bit, for any power of two from 2⁻¹⁰⁰ to
// 2¹⁰⁰ and any lens. Lengths in the answer are in these units. Maps have the range of squares in single precision.
import { type CameraModel, type ImageCamera, init, PointCloud, transfer } from "hidden-point-removal";
import { describe, expect, it } from "vitest";

import { CAMERAS, Part, PLACES, QUESTIONS } from "../fuzz/border/table";
import { bumpySphere } from "./support";

await init();
const positions = Float64Array.from(bumpySphere(7, 600));
const ALL = new Part(positions.length / 3);
const LENSES: [CameraModel, number[]][] = [
  ["SIMPLE_PINHOLE", []],
  ["PINHOLE", []],
  ["SIMPLE_RADIAL", [-0.1]],
  ["RADIAL", [-0.1, 0.02]],
  ["OPENCV", [-0.1, 0.02, 0.001, -0.002]],
  ["OPENCV_FISHEYE", [-0.1, 0.02, 0.001, -0.002]],
  ["FULL_OPENCV", [-0.1, 0.02, 0.001, -0.002, 0.01, 0.02, 0.01, 0.001]],
  ["FOV", [0.9]],
  ["SIMPLE_RADIAL_FISHEYE", [-0.1]],
  ["RADIAL_FISHEYE", [-0.1, 0.02]],
  ["THIN_PRISM_FISHEYE", [-0.1, 0.02, 0.001, -0.002, 0.01, 0.002, 0.001, 0.001]],
];
const POWERS = [-100, -64, -63, -53, -52, -31, 1, 40, 46, 47, 63, 100];
/** Maps have other ranges, but no lens. */
const OF_LENSES = [-100, -31, 1, 63, 100];
/** Also the scales of looks, which an answer tells as its inversion. */
const LENGTHS = ["radius", "thickness", "exponential", "depths", "ranges", "looks"];

const isLens = (tree: object): tree is ImageCamera => "cameraToWorld" in tree;
const view = (values: unknown, by: number) => (values as Float64Array).map((value) => value * by);

/** Arguments in other units: places, poses and thicknesses, but no image, mask, index or direction. */
function inUnits(tree: unknown, by: number, [model, distortion]: (typeof LENSES)[number]): unknown {
  if (tree instanceof Float64Array) return [3, PLACES].includes(tree.length) ? view(tree, by) : tree;
  if (typeof tree !== "object" || tree === null || ArrayBuffer.isView(tree)) return tree;
  if (Array.isArray(tree)) return tree.map((branch) => inUnits(branch, by, [model, distortion]));
  if (isLens(tree)) {
    const pose = Array.from(tree.cameraToWorld!, (x, i) => (i >= 12 && i < 15 ? x * by : x));
    return { ...tree, cameraToWorld: pose, model, distortion };
  }
  return Object.fromEntries(
    Object.entries(tree).map(([key, value]) => [
      key,
      key === "thickness" ? (value as number) * by : key === "up" ? value : inUnits(value, by, [model, distortion]),
    ]),
  );
}

/** An answer in the units of 1. */
function outOf(answer: unknown, by: number): unknown {
  if (typeof answer !== "object" || answer === null || ArrayBuffer.isView(answer)) return answer;
  if (Array.isArray(answer)) return answer.map((branch) => outOf(branch, by));
  const told = Object.entries(answer).map(([key, value]: [string, unknown]) => {
    const isLength = LENGTHS.includes(key) && (key !== "looks" || Array.isArray(value));
    if (!isLength || typeof value === "string") return [key, outOf(value, by)];
    return [key, typeof value === "number" ? value / by : view(value, 1 / by)];
  });
  return Object.fromEntries(told);
}

describe.each(LENSES)("%s", (...lens) => {
  const ask = (name: string, by: number, options: object) => {
    const cloud = new PointCloud(positions.map((x) => x * by));
    const at = Float64Array.of(0.5, 1, 5);
    const args = QUESTIONS[name]!(at, ALL, ALL.length);
    const given = inUnits([...args.slice(0, -1), { ...(args.at(-1) as object), ...options }], by, lens) as [never];
    const answer =
      name === "transfer"
        ? transfer(cloud, ...(given as unknown as [never, never]))
        : (cloud as unknown as Record<string, (...all: unknown[]) => unknown>)[name]!(...given);
    const told =
      name === "visibilityMap"
        ? (answer as ReturnType<PointCloud["visibilityMap"]>).hides(positions.map((x) => x * by))
        : answer;
    cloud.dispose();
    return outOf(told, by);
  };
  const takesLens = Object.keys(QUESTIONS).filter((name) =>
    JSON.stringify(QUESTIONS[name]!([1, 2, 3], ALL, ALL.length)).includes("convention"),
  );
  it.each(lens[0] === "PINHOLE" ? Object.keys(QUESTIONS) : takesLens)("%s", (name) => {
    const hasLooks = !["autoRadius", "reconstruct", "illuminate"].includes(name);
    const choices = [{}, ...(hasLooks ? [{ looks: 3 }, { looks: 2, thickness: 0.02 }] : [])];
    const weights = name === "transfer" ? (["distance", "angle", "score"] as const) : [];
    const more = weights.map((one) => ({ looks: 3, weights: one }));
    for (const options of [...choices, ...more]) {
      const expected = ask(name, 1, options);
      for (const power of lens[0] === "PINHOLE" ? POWERS : OF_LENSES) {
        // A map is for distances from 10⁻¹⁵ to 10¹⁵. The farthest point is 6 units from the viewpoint, and that 5 from the origin.
        const isBlind = name === "visibilityMap" && (6 * 2 ** power < 1e-15 || 11 * 2 ** power > 1e15);
        const right = isBlind ? (expected as Uint8Array).map(() => 0) : expected;
        expect([power, ask(name, 2 ** power, options)]).toEqual([power, right]);
      }
    }
  });
});

it("every camera of the table sees points", () => {
  expect(CAMERAS.map((camera) => new PointCloud(positions).visibleFromCamera(camera).count > 50)).toEqual([true, true]);
});
