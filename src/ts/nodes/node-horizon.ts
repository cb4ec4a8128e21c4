import { concatenated } from "../base/memory.js";
import { Horizon } from "../cloud/horizon.js";
import type { MergeOptions } from "../cloud/merge.js";
import type { Visibility } from "../cloud/visibility.js";
import type { VisibilityOptions } from "../query/view-options.js";
import type { CloudNode } from "./node.js";

/** The most points of the horizon, so that it is made within a frame or a few. Fewer points hide less, never wrongly. */
const MOST_POINTS = 50_000;

/** The visible points of a node, as they were in an answer. */
interface SeenNode {
  node: CloudNode;
  revision: number;
  /** Their indices among the node's points. */
  own: Uint32Array;
}

/** The answer for one viewpoint, and the horizon of its visible points. */
export class NodeHorizon {
  readonly #viewpoint: readonly number[];
  readonly #options: MergeOptions;
  readonly #isFixed: boolean;
  readonly #version: number;
  readonly #seen: SeenNode[] = [];
  #horizon: Horizon | undefined;

  /**
   * @param version the version of the set of nodes that the answer is about.
   * @param asked the options of the question. If they give the radius or the scale as a number, more
   *   nodes only hide more.
   */
  constructor(viewpoint: readonly number[], answer: Visibility, asked: VisibilityOptions, version: number) {
    const { radius, inversion } = answer;
    const isExponential = typeof inversion === "object" && "exponential" in inversion;
    this.#viewpoint = viewpoint;
    this.#options = isExponential ? { inversion } : { radius, inversion };
    this.#isFixed =
      typeof asked.radius === "number" ||
      (typeof asked.inversion === "object" &&
        "exponential" in asked.inversion &&
        asked.inversion.exponential !== "auto");
    this.#version = version;
  }

  /** Whether an answer to this question has a horizon: one flip of the points where they are. */
  static serves({ denoise, vote, looks, draft }: VisibilityOptions): boolean {
    return denoise === undefined && vote === undefined && looks === undefined && draft !== true;
  }

  add(node: CloudNode, own: Uint32Array): void {
    this.#seen.push({ node, revision: node.revision, own });
  }

  /**
   * Whether what this horizon hides is still hidden. An automatic radius changes with the nodes. With a
   * number, nodes may come, but those with visible points may not go or change.
   */
  holds(version: number, isPresent: (node: CloudNode) => boolean): boolean {
    if (version === this.#version) {
      return true;
    }
    return this.#isFixed && this.#seen.every(({ node, revision }) => isPresent(node) && node.revision === revision);
  }

  /** @throws HprError `option`, `too-large`, `not-initialised`, `internal`. */
  hidesBox(min: ArrayLike<number>, max: ArrayLike<number>): boolean {
    this.#horizon ??= this.#made();
    return this.#horizon.hidesBox(min, max);
  }

  dispose(): void {
    this.#horizon?.dispose();
  }

  #made(): Horizon {
    const horizon = new Horizon(this.#viewpoint, this.#options);
    const step = Math.ceil(this.#seen.reduce((sum, { own }) => sum + own.length, 0) / MOST_POINTS);
    const parts = this.#seen.map(({ node, own }) => node.positionsOf(own.filter((_, i) => i % step === 0)));
    horizon.add(concatenated(parts));
    return horizon;
  }
}
