import type { OctreeNode } from "./tree.js";

interface Waiting {
  node: OctreeNode;
  /** How large the node looks from the viewpoint: its width by its distance. */
  size: number;
  number: number;
}

/** Nodes that wait to be read. The one that looks largest comes first. A node comes after its parent. */
export class NodeQueue {
  readonly #viewpoint: readonly number[];
  /** A binary heap. */
  readonly #heap: Waiting[] = [];
  #added = 0;

  constructor(viewpoint: readonly number[]) {
    this.#viewpoint = viewpoint;
  }

  get nodes(): OctreeNode[] {
    return this.#heap.map(({ node }) => node);
  }

  push(node: OctreeNode): void {
    const heap = this.#heap;
    heap.push({ node, size: 2 ** -node.depth / this.#distance(node), number: this.#added++ });
    let at = heap.length - 1;
    while (at > 0) {
      const above = (at - 1) >> 1;
      if (!isBefore(heap[at]!, heap[above]!)) {
        return;
      }
      this.#swap(at, above);
      at = above;
    }
  }

  pop(): OctreeNode | undefined {
    const heap = this.#heap;
    const first = heap[0];
    const last = heap.pop();
    if (heap.length > 0) {
      heap[0] = last!;
      this.#sink();
    }
    return first?.node;
  }

  #sink(): void {
    const heap = this.#heap;
    let at = 0;
    for (;;) {
      let next = at;
      for (const below of [2 * at + 1, 2 * at + 2]) {
        if (below < heap.length && isBefore(heap[below]!, heap[next]!)) {
          next = below;
        }
      }
      if (next === at) {
        return;
      }
      this.#swap(at, next);
      at = next;
    }
  }

  #swap(a: number, b: number): void {
    const heap = this.#heap;
    [heap[a], heap[b]] = [heap[b]!, heap[a]!];
  }

  /** 0 inside of the node's box. */
  #distance({ min, max }: OctreeNode): number {
    const gaps = this.#viewpoint.map((at, axis) => Math.max(min[axis]! - at, at - max[axis]!, 0));
    return Math.hypot(...gaps);
  }
}

function isBefore(a: Waiting, b: Waiting): boolean {
  if (a.size !== b.size) {
    return a.size > b.size;
  }
  return a.node.depth === b.node.depth ? a.number < b.number : a.node.depth < b.node.depth;
}
