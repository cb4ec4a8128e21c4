import { allocating } from "../base/memory.js";
import { PointCloud } from "../cloud/cloud.js";
import { runningInstance } from "../instance/instance.js";
import { init } from "../loader.js";
import { WorkerPointCloud } from "../worker/client.js";
import type { Cloud } from "../worker/followed-view.js";
import type { ReadPositions } from "./attribute.js";

/**
 * Makes a cloud in the worker that all filters share, or in this thread. In this thread it is made at once if the wasm
 * is running.
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
