import { init } from "../loader.js";
import { type MergeOptions, mergeVisible, type VisiblePart } from "../merge.js";
import { WorkerMerger } from "../worker/merger.js";

/** `mergeVisible`, here or in the worker. */
export interface Merger {
  merge(parts: readonly VisiblePart[], viewpoint: ArrayLike<number>, options: MergeOptions): Uint32Array | Promise<Uint32Array>;
  dispose(): void | Promise<void>;
}

export async function startMerger(inWorker: boolean): Promise<Merger> {
  if (inWorker) {
    return WorkerMerger.create();
  }
  await init();
  return { merge: mergeVisible, dispose: () => undefined };
}
