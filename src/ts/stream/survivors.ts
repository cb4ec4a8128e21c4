import { concatenated } from "../base/memory.js";
import { Horizon } from "../cloud/horizon.js";
import type { MergeOptions } from "../cloud/merge.js";
import type { NodePoints, OctreeNode } from "./tree.js";

/** The visible points of one node. */
export interface VisibleNode {
  /** The name of the node in its format, such as `2-0-1-3` (COPC) or `r046` (Potree). */
  readonly key: string;
  /** The numbers of the visible points among the node's points, ascending. */
  readonly indices: Uint32Array;
  /** x, y, z of each of them. */
  readonly positions: Float64Array;
  /** Red, green and blue of each of them, as the file has them. Undefined without the option `colors`, or if the file has none. */
  readonly colors: Uint16Array | undefined;
}

/** The horizon grows when this many points wait to join it, or this share of the points in it. */
const FEW = 10_000;
const SHARE = 1 / 4;

/**
 * The points of the nodes so far that may be visible, and the horizon that hides the others.
 *
 * What the horizon hides is hidden in the whole cloud. When all nodes were screened, the points that
 * are left are exactly the visible points.
 */
export class Survivors {
  readonly #horizon: Horizon;
  /** The points in the horizon that are visible among them. */
  #inside: VisibleNode[] = [];
  /** The points that are not in the horizon yet, and that it does not hide. */
  #waiting: VisibleNode[] = [];
  #count = 0;
  #waitingCount = 0;

  constructor(viewpoint: readonly number[], options: MergeOptions) {
    this.#horizon = new Horizon(viewpoint, options);
  }

  /** The number of points that are kept. */
  get count(): number {
    return this.#count;
  }

  /** Whether enough points wait for the horizon to grow. */
  get isDue(): boolean {
    const inside = this.#count - this.#waitingCount;
    return this.#waitingCount > 0 && this.#waitingCount >= (inside === 0 ? 1 : Math.max(FEW, SHARE * inside));
  }

  get isWaiting(): boolean {
    return this.#waitingCount > 0;
  }

  /** The visible points among those that were in the horizon when it last grew. The list does not change. */
  get visible(): readonly VisibleNode[] {
    return this.#inside;
  }

  /** Whether all points of a node and of the nodes below it are hidden. */
  hides({ min, max }: OctreeNode): boolean {
    // A cell outside of the file's own box has no room for points.
    return min.every((least, axis) => least <= max[axis]!) && this.#horizon.hidesBox(min, max);
  }

  /** Takes up the points of a node that the horizon does not hide. */
  add(node: OctreeNode, { positions, colors }: NodePoints): void {
    const indices = Uint32Array.from({ length: positions.length / 3 }, (_, i) => i);
    const part = this.#screened({ key: node.key, indices, positions, colors });
    if (part.indices.length > 0) {
      this.#waiting.push(part);
      this.#waitingCount += part.indices.length;
      this.#count += part.indices.length;
    }
  }

  /** Lets the waiting points join the horizon, and drops all points that it hides then. */
  grow(): void {
    if (this.#waitingCount > 0) {
      this.#horizon.add(concatenated(this.#waiting.map(({ positions }) => positions)));
    }
    const all = [...this.#inside, ...this.#waiting].map((part) => this.#screened(part));
    this.#inside = all.filter(({ indices }) => indices.length > 0);
    this.#waiting = [];
    this.#waitingCount = 0;
    this.#count = this.#inside.reduce((sum, { indices }) => sum + indices.length, 0);
  }

  dispose(): void {
    this.#horizon.dispose();
  }

  /** The same part without the points that the horizon hides. */
  #screened(part: VisibleNode): VisibleNode {
    const { key, indices, positions, colors } = part;
    const left = this.#horizon.screen(positions);
    if (left.length === indices.length) {
      return part;
    }
    return {
      key,
      indices: left.map((k) => indices[k]!),
      positions: threesAt(left, positions, new Float64Array(3 * left.length)),
      colors: colors && threesAt(left, colors, new Uint16Array(3 * left.length)),
    };
  }
}

/** Copies the three numbers of some points. */
function threesAt<T extends Float64Array | Uint16Array>(points: Uint32Array, from: T, to: T): T {
  for (let i = 0; i < points.length; i++) {
    const at = 3 * points[i]!;
    to[3 * i] = from[at]!;
    to[3 * i + 1] = from[at + 1]!;
    to[3 * i + 2] = from[at + 2]!;
  }
  return to;
}
