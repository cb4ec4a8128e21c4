import { PointCloud } from "../cloud/cloud.js";
import { runningInstance } from "../instance/instance.js";
import { init } from "../loader.js";
import { WorkerPointCloud } from "../worker/client.js";
import { listHiddenToo } from "../worker/listing.js";
import type { ReadPositions } from "./attribute.js";

/** Both classes give the same answers. A `WorkerPointCloud` gives them as promises. */
export type Cloud = PointCloud | WorkerPointCloud;

/**
 * Makes a cloud in the worker that all filters share, or in this thread. In this thread it is made
 * at once if the wasm is running. If hidden points are dimmed, the worker lists them.
 */
export function prepareCloud(
  { numbers, own }: ReadPositions,
  options: { inWorker: boolean; dim: boolean; nonFinite: "error" | "skip" },
): Cloud | Promise<Cloud> {
  const { inWorker, dim, nonFinite } = options;
  if (inWorker) {
    return WorkerPointCloud.create(numbers, { nonFinite, shared: true, transfer: own }).then((cloud) => {
      if (dim) listHiddenToo(cloud);
      return cloud;
    });
  }
  const build = () => new PointCloud(numbers, { nonFinite });
  return runningInstance() === undefined ? init().then(build) : build();
}
