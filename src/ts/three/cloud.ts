import { PointCloud } from "../cloud/cloud.js";
import type { Visibility } from "../cloud/visibility.js";
import type { VisibilityMap } from "../cloud/visibility-map.js";
import type { AskedStage } from "../follow/refinement.js";
import { allocating } from "../base/memory.js";
import { runningInstance } from "../instance/instance.js";
import { init } from "../loader.js";
import type { Place } from "../query/place.js";
import type { VisibilityOptions } from "../query/view-options.js";
import { WorkerPointCloud } from "../worker/client.js";
import type { ReadPositions } from "./attribute.js";

/** Both classes give the same answers. A `WorkerPointCloud` gives them as promises. */
export type Cloud = PointCloud | WorkerPointCloud;
export type Seen = Visibility | VisibilityMap;

/**
 * Makes a cloud in the worker that all filters share, or in this thread. In this thread it is made
 * at once if the wasm is running.
 */
export function prepareCloud(
  { numbers, own }: ReadPositions,
  { inWorker, nonFinite }: { inWorker: boolean; nonFinite: "error" | "skip" },
): Cloud | Promise<Cloud> {
  if (inWorker) {
    // The positions are read again if the worker is lost, so the cloud need not keep them.
    const given = own ? numbers : allocating("a copy of the positions", () => numbers.slice());
    return WorkerPointCloud.create(given, { nonFinite, shared: true, transfer: true });
  }
  const build = () => new PointCloud(numbers, { nonFinite });
  return runningInstance() === undefined ? init().then(build) : build();
}

/** Asks either kind of cloud. The signal works only in a worker: elsewhere, the answer comes at once. */
export function see(
  cloud: Cloud,
  { from, isDirection }: Place,
  { kind, options, signal }: AskedStage<VisibilityOptions>,
): Seen | Promise<Seen> {
  const asked = cloud instanceof WorkerPointCloud ? { ...options, signal } : options;
  if (kind === "map") {
    return cloud.visibilityMap(from, asked);
  }
  return isDirection ? cloud.visibleFromDirection(from, asked) : cloud.visibleFrom(from, asked);
}
