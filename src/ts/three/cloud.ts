import { allocating } from "../base/errors.js";
import { PointCloud } from "../cloud/cloud.js";
import { runningInstance } from "../instance/instance.js";
import { engine } from "../instance/own-engine.js";
import { initFrom } from "../instance/start.js";
import { ownWasm } from "../own-wasm.js";
import { WorkerPointCloud } from "../worker/client.js";
import type { Cloud } from "../worker/followed-cloud.js";

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
  return runningInstance() === undefined ? initFrom(engine, ownWasm(), undefined).then(build) : build();
}
