import type { NodePoints, OctreeNode, Tree } from "./tree.js";

/** The points of a node, and the number of bytes that were read for it now. */
export interface Loaded extends NodePoints {
  bytes: number;
}

/** Reads nodes, and keeps those that were used last, so that another viewpoint finds them. */
export class NodeCache {
  readonly #tree: Tree;
  /** The most points that are kept. */
  #most: number;
  /** In the order of their last use. */
  readonly #kept = new Map<OctreeNode, NodePoints>();
  #points = 0;

  constructor(tree: Tree, most: number) {
    this.#tree = tree;
    this.#most = most;
  }

  get points(): number {
    return this.#points;
  }

  async load(node: OctreeNode, signal?: AbortSignal): Promise<Loaded> {
    const kept = this.#kept.get(node);
    if (kept !== undefined) {
      this.#kept.delete(node);
      this.#kept.set(node, kept);
      return { ...kept, bytes: 0 };
    }
    if (node.count === 0) {
      return { positions: new Float64Array(0), colors: undefined, bytes: 0 };
    }
    const points = await this.#tree.read(node, signal);
    this.#keep(node, points);
    return { ...points, bytes: node.part.length };
  }

  /** Drops all nodes, and keeps none from now on. */
  close(): void {
    this.#most = 0;
    this.#kept.clear();
    this.#points = 0;
  }

  #keep(node: OctreeNode, points: NodePoints): void {
    if (this.#kept.has(node) || node.count > this.#most) {
      return;
    }
    this.#kept.set(node, points);
    this.#points += node.count;
    for (const [oldest] of this.#kept) {
      if (this.#points <= this.#most) {
        break;
      }
      this.#kept.delete(oldest);
      this.#points -= oldest.count;
    }
  }
}
