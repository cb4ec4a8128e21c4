import { allocating } from "../base/memory.js";
import { PointCloud } from "../cloud/cloud.js";
import type { AskedStage, Seen } from "../follow/view.js";
import { runningInstance } from "../instance/instance.js";
import { init } from "../loader.js";
import type { Place } from "../query/place.js";
import type { VisibilityOptions } from "../query/view-options.js";
import { WorkerPointCloud } from "./client.js";

/** Both classes give the same answers. A `WorkerPointCloud` gives them as promises. */
export type Cloud = PointCloud | WorkerPointCloud;

/**
 * Makes a cloud in the worker that all adapters share, or in this thread, where it is made at once if the wasm is
 * running. `isOwn`: the memory of the numbers may be given away.
 */
export function prepareCloud(
  numbers: Float32Array | Float64Array,
  isOwn: boolean,
  { inWorker, nonFinite }: { inWorker: boolean; nonFinite: "error" | "skip" },
): Cloud | Promise<Cloud> {
  if (inWorker) {
    // The positions are read again if the worker is lost, so the cloud need not keep them.
    const given = isOwn ? numbers : allocating("a copy of the positions", () => numbers.slice());
    return WorkerPointCloud.create(given, { nonFinite, shared: true, transfer: true });
  }
  const build = () => new PointCloud(numbers, { nonFinite });
  return runningInstance() === undefined ? init().then(build) : build();
}

/** Asks either kind of cloud. The signal works only in a worker: elsewhere, the answer comes at once. */
export function see(
  cloud: Cloud,
  { from, isDirection }: Place,
  { kind, options, signal, points }: AskedStage<VisibilityOptions>,
): Seen | Promise<Seen> {
  const asked = cloud instanceof WorkerPointCloud ? { ...options, signal } : options;
  if (kind === "map") {
    return cloud.visibilityMap(from, { ...asked, points });
  }
  return isDirection ? cloud.visibleFromDirection(from, asked) : cloud.visibleFrom(from, asked);
}
