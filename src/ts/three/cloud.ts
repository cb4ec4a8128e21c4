import { PointCloud } from "../cloud/cloud.js";
import { runningInstance } from "../instance/instance.js";
import { init } from "../loader.js";
import { WorkerPointCloud } from "../worker/client.js";
import { listHiddenToo } from "../worker/listing.js";
import type { ReadPositions } from "./attribute.js";

/** Both answer alike, one of them with promises. */
export type Cloud = PointCloud | WorkerPointCloud;

/**
 * A cloud in the worker that all filters share, or else here: at once where the wasm is
 * running. To dim hidden points, the worker lists them.
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
