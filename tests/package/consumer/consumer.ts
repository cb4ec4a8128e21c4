// A user's code against the published types. It is compiled, never run.
import {
  hiddenPointRemoval,
  HprError,
  type HprErrorCode,
  init,
  type InitInput,
  type IlluminationOptions,
  initSync,
  type Inversion,
  type MergeOptions,
  mergeVisible,
  permissibleCurvature,
  PointCloud,
  type PointCloudOptions,
  radiusBound,
  type RadiusRule,
  type Reconstruction,
  type ReconstructionOptions,
  type ResolvedInversion,
  ringOfViewpoints,
  type Visibility,
  type VisibilityOptions,
  type VisiblePart,
} from "hidden-point-removal";
import { init as initInline } from "hidden-point-removal/inline";
import * as lite from "hidden-point-removal/lite";
import { openOctree, type OctreeStep, type OctreeViewOptions } from "hidden-point-removal/stream";
import { WorkerPointCloud } from "hidden-point-removal/worker";

const inputs: InitInput[] = [
  "hpr.wasm",
  new URL("https://example.org/hpr.wasm"),
  new Uint8Array(8),
  new ArrayBuffer(8),
];
const options: VisibilityOptions = { exponent: 3 };
const reading: PointCloudOptions = { stride: 4, nonFinite: "skip" };
const perhaps = undefined as number | undefined;

export async function everything(): Promise<HprErrorCode | undefined> {
  await init();
  await init(inputs[0]);
  initSync(new Uint8Array(8));
  await initInline();
  try {
    using cloud = new PointCloud(new Float32Array(12), reading);
    cloud.append(new Uint16Array(4));
    // @ts-expect-error BigInts are no coordinates.
    cloud.append(new BigInt64Array(4));
    const visible: Visibility = cloud.visibleFrom([0, 0, 5], options);
    const indices: Uint32Array = visible.indices;
    const { radius, exponent, evaluations } = cloud.autoRadius(new Float64Array(3));
    console.log(indices, radius, exponent, evaluations, visible.mask(), visible.inversion);
    console.log(hiddenPointRemoval([1, 2, 3], [0, 0, 5], { radius: 10, ...reading }).count);

    cloud.visibleFrom([0, 0, 5], { radius: perhaps, exponent: undefined, inversion: undefined });
    console.log(new PointCloud([], { dimension: perhaps, stride: perhaps, nonFinite: undefined }).skipped);
    cloud.append(new Float64Array(3));
    cloud.remove(new Uint32Array([0]));
    cloud.remove([1]);

    const parts: VisiblePart[] = [{ positions: [1, 2, 3], ids: new Uint32Array([7]) }];
    const together: MergeOptions = { radius: 100 };
    const ids: Uint32Array = mergeVisible(parts, [0, 0, 5], together);
    console.log(ids);

    const inversions: Inversion[] = ["spherical", { power: 2 }, { exponential: 0.1 }, { exponential: "auto" }];
    const rules: RadiusRule[] = ["auto", "opposite"];
    const ring: number[][] = ringOfViewpoints([0, 0, 5], new Float32Array(3), { count: 5, fraction: perhaps });
    const seen = cloud.visibleFromAtLeast(2, [...ring, new Float64Array(3)], { inversion: inversions[1] });
    const inversion: ResolvedInversion = cloud.visibleFromAny(ring, { radius: rules[1] }).inversion;
    mergeVisible(parts, [0, 0, 5], { radius: seen.radius, inversion });
    const meshing: ReconstructionOptions = { maxEdge: Infinity };
    const mesh: Reconstruction = cloud.reconstruct([0, 0, 5], meshing);
    const lighting: IlluminationOptions = { triangles: mesh.triangles, smoothing: 2, ambient: 0.1, exponent: 3 };
    const brightness: Float32Array = cloud.illuminate([[0, 0, 5]], lighting);
    console.log(
      brightness,
      cloud.visibleFromDirection([0, 0, -1]).count,
      cloud.autoRadius([0, 0, 5], "opposite").radius,
    );
    console.log(permissibleCurvature(100, 5, 1), radiusBound(1, 2, 0.1));
    new PointCloud(new Float32Array(4), { dimension: 2 }).dispose();

    const controller = new AbortController();
    const remote = await WorkerPointCloud.create([1, 2, 3], { transfer: false, signal: controller.signal });
    await remote.visibleFrom([0, 0, 5], { latest: true, signal: controller.signal, radius: "auto" });
    await remote.visibleFrom([0, 0, 5], { latest: undefined, signal: undefined });
    await remote.append([4, 5, 6]);
    await remote.remove([0]);
    const far: Float32Array = await remote.illuminate([[0, 0, 5]], lighting);
    const remoteMesh: Reconstruction = await remote.reconstruct([0, 0, 5], meshing);
    await remote.visibleFromAny(ring);
    await remote.visibleFromAtLeast(1, ring, { radius: "opposite" });
    await remote.visibleFromDirection([0, 0, 1]);
    console.log(far, remoteMesh.triangles, (await remote.autoRadius([0, 0, 5], "opposite")).evaluations);
    await remote.dispose();

    // @ts-expect-error -- a cloud keeps its length
    cloud.length = 3;
    // @ts-expect-error -- there is no such rule
    cloud.visibleFrom([0, 0, 5], { radius: "best" });
    // @ts-expect-error -- merging needs numbers
    mergeVisible(parts, [0, 0, 5], { inversion: { exponential: "auto" } });
    // @ts-expect-error -- there is no such option
    cloud.visibleFrom([0, 0, 5], { farness: 3 });
    // @ts-expect-error -- a string is no list of numbers
    cloud.visibleFrom("0, 0");
  } catch (error) {
    return error instanceof HprError ? error.code : undefined;
  }
  return undefined;
}

export async function stream(view: OctreeViewOptions): Promise<OctreeStep | undefined> {
  const octree = await openOctree("https://example.org/a.copc.laz", { cache: 1000 });
  let last: OctreeStep | undefined;
  for await (const step of octree.visibleFrom([0, 0, 1], { ...view, inversion: { exponential: "auto" } })) {
    last = step;
  }
  // @ts-expect-error There is no such format.
  await openOctree(3);
  return last;
}

export async function small(): Promise<lite.HprErrorCode | undefined> {
  await lite.init();
  lite.initSync(new Uint8Array(8));
  using cloud = new lite.PointCloud(new Float32Array(12), { dimension: 2, nonFinite: "skip" });
  cloud.append([1, 2]);
  cloud.remove([0]);
  const visible: lite.Visibility = cloud.visibleFrom([0, 5], { exponent: 3, inversion: "spherical" });
  // An answer's radius and inversion are options.
  cloud.visibleFrom({ x: 0, y: 5, z: 0 }, { radius: visible.radius, inversion: visible.inversion });
  console.log(visible.mask(), visible.exact, cloud.autoRadius([0, 5], "auto").radius);
  // @ts-expect-error The small module knows no looks.
  cloud.visibleFrom([0, 5], { looks: 3 });
  // @ts-expect-error And not the paper's rule of the radius.
  cloud.visibleFrom([0, 5], { radius: "opposite" });
  // @ts-expect-error And no scores.
  console.log(visible.scores);
  // @ts-expect-error And no higher dimensions.
  console.log(lite.hiddenPointRemoval([0, 0, 0, 0], [0, 0, 0, 0], { dimension: 4 }));
  return undefined;
}
