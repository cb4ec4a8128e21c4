import { concatenated } from "../base/errors.js";
import { Horizon } from "../cloud/horizon.js";
import type { MergeOptions } from "../cloud/merge.js";
import type { ResolvedInversion } from "../query/view-options.js";
import { untilAborted, whenAborted } from "../worker/abort.js";
import type { Loaded, NodeCache } from "./tree.js";
import type { OctreeProgress, ViewRequest } from "./options.js";
import { type NodePoints, type OctreeNode, subtree, type Tree } from "./tree.js";

interface Waiting {
  node: OctreeNode;
  /** How large the node looks from the viewpoint: its width by its distance. */
  size: number;
  number: number;
}

/** Nodes that wait to be read. The one that looks largest comes first. A node comes after its parent. */
class NodeQueue {
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
class Survivors {
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
export class OctreeView {
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
