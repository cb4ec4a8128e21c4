import type { MergeOptions } from "../cloud/merge.js";
import type { ResolvedInversion } from "../query/view-options.js";
import { untilAborted, whenAborted } from "../worker/abort.js";
import type { Loaded, NodeCache } from "./cache.js";
import type { OctreeProgress, ViewRequest } from "./options.js";
import { NodeQueue } from "./queue.js";
import { concatenated } from "../base/memory.js";
import { Survivors, type VisibleNode } from "./survivors.js";
import { type OctreeNode, subtree, type Tree } from "./tree.js";

/**
 * What is known of a view so far. A later step shows points of more nodes. It never shows a point
 * that an earlier step had read and hidden.
 */
export class OctreeStep {
  /** Whether the visible points are exactly those of the whole cloud. */
  readonly exact: boolean;
  /** The numbers of nodes that were read, that are hidden, and of which neither is known; of the nodes listed so far. */
  readonly nodes: { readonly read: number; readonly hidden: number; readonly undecided: number };
  /** The number of bytes of points that were fetched for this view. Nodes that were kept cost none. */
  readonly bytes: number;
  /** The number of points of the nodes that were read. */
  readonly points: number;
  /** The visible points, node by node. Do not change the arrays: later steps share them. */
  readonly visible: readonly VisibleNode[];
  /** The number of visible points. */
  readonly count: number;
  /** R, or 0 if the inversion has none. */
  readonly radius: number;
  /** The inversion with numbers. The whole cloud asked with it answers the same. */
  readonly inversion: ResolvedInversion;

  /** @internal */
  constructor(tally: Tally, undecided: number, visible: readonly VisibleNode[], isLast: boolean, merge: MergeOptions) {
    const { read, hidden, bytes, points } = tally;
    this.exact = isLast && undecided === 0;
    this.nodes = { read, hidden, undecided };
    this.bytes = bytes;
    this.points = points;
    this.visible = visible;
    this.count = visible.reduce((sum, { indices }) => sum + indices.length, 0);
    this.radius = merge.radius ?? 0;
    this.inversion = merge.inversion ?? "spherical";
  }

  /** x, y, z of all visible points, one after another, in the order of `visible`: a new array. */
  positions(): Float64Array<ArrayBuffer> {
    return concatenated(this.visible.map(({ positions }) => positions));
  }

  /**
   * Red, green and blue of all visible points, as the file has them, in the order of `positions()`: a new array.
   * Undefined without the option `colors` of `openOctree`, or if the file has no colors.
   */
  colors(): Uint16Array<ArrayBuffer> | undefined {
    const all = new Uint16Array(3 * this.count);
    let at = 0;
    for (const { colors } of this.visible) {
      if (!colors) return undefined;
      all.set(colors, at);
      at += colors.length;
    }
    return all;
  }
}

/** What a view has done so far. */
interface Tally {
  /** The number of nodes that were read. */
  read: number;
  hidden: number;
  bytes: number;
  points: number;
}

/** A node that is being read. */
interface Coming {
  node: OctreeNode;
  loaded: Promise<Loaded>;
}

/** One view of an octree: reads its nodes, the best ones first, until all are read or hidden. */
export class Look {
  readonly #tree: Tree;
  readonly #cache: NodeCache;
  readonly #request: ViewRequest;
  readonly #merge: MergeOptions;
  readonly #queue: NodeQueue;
  readonly #survivors: Survivors;
  readonly #end = new AbortController();
  readonly #coming: Coming[] = [];
  readonly #tally: Tally;
  /** Whether the next node does not fit in the budget. */
  #isFull = false;

  /** @param bytes were read for this view before. */
  constructor(tree: Tree, cache: NodeCache, request: ViewRequest, merge: MergeOptions, bytes: number) {
    this.#tree = tree;
    this.#cache = cache;
    this.#request = request;
    this.#merge = merge;
    this.#queue = new NodeQueue(request.viewpoint);
    this.#survivors = new Survivors(request.viewpoint, merge);
    this.#tally = { read: 0, hidden: 0, bytes, points: 0 };
  }

  async *steps(): AsyncGenerator<OctreeStep, void, undefined> {
    const { signal, onProgress } = this.#request;
    const forget =
      signal &&
      whenAborted(signal, () => {
        this.#end.abort();
      });
    try {
      const { facts, root } = this.#tree;
      if (facts.points > 0 || root.pageLength > 0) {
        this.#queue.push(root);
      }
      while (await this.#readNext()) {
        onProgress(this.#progress());
        if (this.#survivors.isDue) {
          this.#survivors.grow();
          yield this.#step(false);
        }
      }
      this.#survivors.grow();
      this.#dropHidden();
      yield this.#step(true);
    } finally {
      forget?.();
      this.#end.abort();
      this.#survivors.dispose();
    }
  }

  /** Takes up the next node. Returns false if there is none. */
  async #readNext(): Promise<boolean> {
    await this.#send();
    const next = this.#coming.shift();
    if (next === undefined) {
      return false;
    }
    const loaded = await untilAborted(this.#end.signal, next.loaded);
    this.#tally.read += 1;
    this.#tally.bytes += loaded.bytes;
    this.#tally.points += loaded.positions.length / 3;
    this.#survivors.add(next.node, loaded);
    return true;
  }

  /** Begins to read as many nodes as may come at the same time. */
  async #send(): Promise<void> {
    while (this.#coming.length < this.#request.requests && !this.#isFull) {
      const node = this.#queue.pop();
      if (node === undefined) {
        return;
      }
      if (this.#survivors.hides(node)) {
        this.#skip(node);
        continue;
      }
      await untilAborted(this.#end.signal, this.#tree.list(node));
      if (!this.#hasRoomFor(node)) {
        this.#queue.push(node);
        // The nodes that are coming may be hidden when they are here.
        this.#isFull = this.#coming.length === 0;
        return;
      }
      const loaded = this.#cache.load(node, this.#end.signal);
      // The error is thrown when the node's turn comes.
      loaded.catch(() => undefined);
      this.#coming.push({ node, loaded });
      for (const child of node.children) this.#queue.push(child);
    }
  }

  #hasRoomFor({ count }: OctreeNode): boolean {
    const held = () => this.#coming.reduce((sum, { node }) => sum + node.count, this.#survivors.count);
    if (held() + count > this.#request.budget && this.#coming.length === 0 && this.#survivors.isWaiting) {
      this.#survivors.grow();
    }
    return held() + count <= this.#request.budget;
  }

  #skip(node: OctreeNode): void {
    this.#tally.hidden += sizeOf(node);
  }

  /** Decides the nodes that were not read, as far as their boxes are hidden. */
  #dropHidden(): void {
    const left: OctreeNode[] = [];
    for (let node = this.#queue.pop(); node !== undefined; node = this.#queue.pop()) {
      if (this.#survivors.hides(node)) {
        this.#skip(node);
      } else {
        left.push(node);
      }
    }
    for (const node of left) this.#queue.push(node);
  }

  #undecided(): number {
    let count = this.#coming.length;
    for (const node of this.#queue.nodes) count += sizeOf(node);
    return count;
  }

  #progress(): OctreeProgress {
    const { read, hidden, bytes } = this.#tally;
    return { read, hidden, bytes };
  }

  #step(isLast: boolean): OctreeStep {
    return new OctreeStep(this.#tally, this.#undecided(), this.#survivors.visible, isLast, this.#merge);
  }
}

/** The number of known nodes from this one down. */
function sizeOf(top: OctreeNode): number {
  const nodes = subtree(top);
  let size = 0;
  while (nodes.next().done !== true) size += 1;
  return size;
}
