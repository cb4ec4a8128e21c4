import { HprError } from "../errors.js";
import { moduleForWorker } from "../loader.js";
import { type MergeOptions, readMerge, type VisiblePart } from "../merge.js";
import { RequestQueue } from "./request-queue.js";

/** `mergeVisible` in the worker that clouds created with `shared` are in. */
export class WorkerMerger {
  readonly #queue = new RequestQueue();

  static async create(): Promise<WorkerMerger> {
    const merger = new WorkerMerger();
    await merger.#queue.start("shared");
    return merger;
  }

  /** The ids of what is visible in the whole cloud; see `mergeVisible`. */
  async merge(
    parts: readonly VisiblePart[],
    viewpoint: ArrayLike<number>,
    options: MergeOptions,
  ): Promise<Uint32Array> {
    const merge = readMerge(parts, viewpoint, options);
    const module = await moduleForWorker();
    return (await this.#queue.ask({ kind: "merge", module, ...merge }, { owner: this })).ids;
  }

  async dispose(): Promise<void> {
    await this.#queue.close(new HprError("disposed", "this merger has been disposed of"));
  }
}
