import { asError } from "../base/errors.js";
import { readBox } from "../cloud/horizon.js";
import type { Visibility } from "../cloud/visibility.js";
import type { AskedStage } from "../follow/refinement.js";
import { runningInstance } from "../instance/instance.js";
import { init } from "../loader.js";
import type { Place } from "../query/place.js";
import type { VisibilityOptions } from "../query/view-options.js";
import type { FollowedCamera } from "../three/cameras.js";
import { NodeHorizon } from "./node-horizon.js";
import type { NodeSet } from "./node-set.js";

/** What the last exact answer for each camera hides, as long as the camera stays there. */
export class NodeHorizons {
  readonly #nodes: NodeSet;
  readonly #failed: (error: Error) => void;
  readonly #horizons = new Map<FollowedCamera, NodeHorizon>();
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
    camera: FollowedCamera,
    { from, isDirection }: Place,
    answer: Visibility,
    { options, isCurrent }: AskedStage<VisibilityOptions>,
    version: number | undefined,
  ): NodeHorizon | undefined {
    if (isDirection || !isCurrent() || version === undefined || !NodeHorizon.serves(options)) {
      return undefined;
    }
    this.drop(camera);
    const horizon = new NodeHorizon([...from], answer, options, version);
    this.#horizons.set(camera, horizon);
    return horizon;
  }

  /** @throws HprError `option`, `too-large`, `internal`. */
  hidesBox(camera: FollowedCamera | undefined, min: ArrayLike<number>, max: ArrayLike<number>): boolean {
    const box = readBox(min, max);
    const horizon = camera && this.#horizons.get(camera);
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

  drop(camera: FollowedCamera): void {
    this.#horizons.get(camera)?.dispose();
    this.#horizons.delete(camera);
  }

  clear(): void {
    for (const camera of [...this.#horizons.keys()]) this.drop(camera);
  }
}
