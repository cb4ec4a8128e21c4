import { asError } from "../base/errors.js";
import { readBox } from "../cloud/horizon.js";
import type { Visibility } from "../cloud/visibility.js";
import type { Turn } from "../follow/gaze.js";
import { runningInstance } from "../instance/instance.js";
import { init } from "../loader.js";
import type { Place } from "../query/place.js";
import type { VisibilityOptions } from "../query/view-options.js";
import type { Watch } from "../three/watch.js";
import { NodeHorizon } from "./node-horizon.js";
import type { NodeSet } from "./node-set.js";

/** What the last exact answer for each camera hides, as long as the camera stays there. */
export class NodeHorizons {
  readonly #nodes: NodeSet;
  readonly #failed: (error: Error) => void;
  readonly #horizons = new Map<Watch, NodeHorizon>();
  /** Starts the wasm in this thread: the cloud may be in a worker. */
  #starting: Promise<void> | undefined;

  /** @param failed is called if the wasm does not start. */
  constructor(nodes: NodeSet, failed: (error: Error) => void) {
    this.#nodes = nodes;
    this.#failed = failed;
  }

  /**
   * Begins the horizon of an answer. Its points are added to it. Undefined if the answer has none, or if
   * the camera has moved on.
   *
   * @param version the version of the set of nodes that the answer is about.
   */
  begin(
    watch: Watch,
    { from, isDirection }: Place,
    answer: Visibility,
    { options, isCurrent }: Turn<VisibilityOptions>,
    version: number | undefined,
  ): NodeHorizon | undefined {
    if (isDirection || !isCurrent() || version === undefined || !NodeHorizon.serves(options)) {
      return undefined;
    }
    this.drop(watch);
    const horizon = new NodeHorizon([...from], answer, options, version);
    this.#horizons.set(watch, horizon);
    return horizon;
  }

  /** @throws HprError `option`, `too-large`, `internal`. */
  hidesBox(watch: Watch | undefined, min: ArrayLike<number>, max: ArrayLike<number>): boolean {
    const box = readBox(min, max);
    const horizon = watch && this.#horizons.get(watch);
    if (horizon?.holds(this.#nodes.version, (node) => this.#nodes.isPresent(node)) !== true) {
      return false;
    }
    if (runningInstance() === undefined) {
      this.#starting ??= init().catch((error: unknown) => {
        this.#failed(asError(error));
      });
      return false;
    }
    return horizon.hidesBox(box.subarray(0, 3), box.subarray(3));
  }

  drop(watch: Watch): void {
    this.#horizons.get(watch)?.dispose();
    this.#horizons.delete(watch);
  }

  clear(): void {
    for (const watch of [...this.#horizons.keys()]) this.drop(watch);
  }
}
