// What throws is refused by the compiler, too.
import type { PointCloud, VisibilityOptions } from "hidden-point-removal";
import type { WorkerPointCloud } from "hidden-point-removal/worker";
import type { HiddenPointFilterOptions } from "hidden-point-removal/three";
import type { HiddenPointNodesFilterOptions } from "hidden-point-removal/nodes";

declare const cloud: PointCloud;
declare const remote: WorkerPointCloud;
const eye = [0, 0, 5];
// A vector of three.js, for example.
declare const vector: { x: number; y: number; z: number };
remote.follow().look(vector);

export const allowed: VisibilityOptions[] = [
  {},
  { radius: 7, inversion: { power: 2 } },
  { exponent: 3, within: { distance: 4 } },
  { looks: 3, scores: true, thickness: 0.1, surface: "noisy" },
];
// The looks at rest take them.
export const filter: HiddenPointFilterOptions = { thickness: 0.1, surface: "noisy", mode: "dim" };

export async function refused(): Promise<void> {
  // @ts-expect-error Two ways to choose R.
  cloud.visibleFrom(eye, { radius: 7, exponent: 3 });
  // @ts-expect-error Looks have their own radii.
  cloud.visibleFrom(eye, { looks: 3, exponent: 3 });
  // @ts-expect-error Looks have their own radii.
  cloud.visibleFrom(eye, { looks: 3, radius: 7 });
  // @ts-expect-error Looks choose the inversion.
  cloud.visibleFrom(eye, { looks: 2, inversion: { power: 2 } });
  // @ts-expect-error Only looks have scores.
  cloud.visibleFrom(eye, { scores: true });
  // @ts-expect-error And a thickness.
  cloud.coverage([eye], { thickness: 0.1 });
  // @ts-expect-error No such option.
  cloud.visibleFrom(eye, { look: 3 });
  // @ts-expect-error Nobody knows what this station has measured.
  cloud.calibrate([{ viewpoint: eye }]);
  // @ts-expect-error Two ways to choose R, in a worker.
  await remote.visibleFrom(eye, { radius: 7, exponent: 3, latest: true });
  // @ts-expect-error Two ways to choose R, for a filter.
  const wrong: HiddenPointFilterOptions = { radius: 7, exponent: 3 };
  // @ts-expect-error Looks choose the inversion, for nodes.
  const nodes: HiddenPointNodesFilterOptions = { looks: 3, exponent: 3 };
  console.log(wrong, nodes);
}

export async function scores(): Promise<Float32Array[]> {
  // @ts-expect-error Not asked for.
  const none: Float32Array = cloud.visibleFrom(eye, { looks: 3 }).scores;
  const here: Float32Array = cloud.visibleFrom(eye, { looks: 3, scores: true }).scores;
  const there = await remote.visibleFrom(eye, { looks: 3, scores: true, latest: true });
  return [none, here, there.scores];
}
