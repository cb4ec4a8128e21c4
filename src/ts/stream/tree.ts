import type { Crs } from "../formats/las/crs.js";
import { broken, type ByteRange } from "./source.js";

/** Three numbers: x, y, z. */
export type Triple = readonly [number, number, number];

/** A box with its borders: its least and its largest x, y, z. */
export interface Box {
  readonly min: Triple;
  readonly max: Triple;
}

/** One node of an octree. */
export interface OctreeNode extends Box {
  /** The name of the node in its format, such as `2-0-1-3` (COPC) or `r046` (Potree). */
  readonly key: string;
  readonly depth: number;
  /** Its cell among the cells of its depth. */
  readonly cell: Triple;
  /** The number of its own points. It is not exact as long as the node is not listed. */
  count: number;
  /** Where its own points are. */
  part: ByteRange;
  children: OctreeNode[];
  /** Where the node and the nodes below it are listed. Undefined if they are listed already. */
  page: ByteRange | undefined;
  /** The length of this page, also after it was read. 0 if the node is in the page of its parent. */
  pageLength: number;
}

/** The points of a node. */
export interface NodePoints {
  /** x, y, z of each point. */
  positions: Float64Array<ArrayBuffer>;
  /** Red, green and blue of each point, as the file has them. Undefined if they are not read, or the file has none. */
  colors: Uint16Array<ArrayBuffer> | undefined;
}

/** The facts of an octree that its header gives. */
export interface TreeFacts {
  /** For messages. */
  name: string;
  /** The number of points of all nodes. */
  points: number;
  /** The cell of the root: a cube. */
  cube: Box;
  /** A box around all points, if it is known. */
  bounds: Box | undefined;
  /** A coordinate is an integer times the scale, plus the offset. */
  scale: Triple;
  offset: Triple;
  crs?: Crs | undefined;
}

/** Octrees are less deep. A deeper one contains itself. */
const DEEPEST = 40;

/**
 * An octree in which each point is in one node, and deeper nodes refine coarser ones. Its nodes are
 * listed page by page.
 */
export abstract class Tree {
  readonly facts: TreeFacts;
  /** How far points may lie outside of their cell: coordinates are rounded after they are sorted into cells. */
  readonly #tolerance: Triple;
  /** The offsets of all pages so far. */
  readonly #pages = new Set<number>();
  readonly #listing = new Map<OctreeNode, Promise<void>>();
  #listed = 0;
  /** The number of known pages that were not read. */
  #unread = 0;

  protected constructor(facts: TreeFacts) {
    const { name, scale, offset, cube, bounds } = facts;
    const numbers = [...scale, ...offset, ...cube.min, ...cube.max, ...(bounds ? [...bounds.min, ...bounds.max] : [])];
    if (!numbers.every(Number.isFinite) || scale.includes(0)) {
      throw broken(name, "its scale, its offset or its box is not a finite number");
    }
    this.facts = facts;
    this.#tolerance = triple((axis) => {
      const largest = Math.max(Math.abs(cube.min[axis]), Math.abs(cube.max[axis]));
      return Math.abs(scale[axis]) + 4 * Number.EPSILON * largest;
    });
  }

  abstract readonly root: OctreeNode;

  /** Reads and checks the points of a listed node. */
  abstract read(node: OctreeNode, signal?: AbortSignal): Promise<NodePoints>;

  /** Reads a page: lists its node and nodes below it. */
  protected abstract readPage(node: OctreeNode, page: ByteRange): Promise<void>;

  /** Lists a node, if it is not listed yet. Several callers may wait for one page. */
  async list(node: OctreeNode): Promise<void> {
    const { page } = node;
    if (page === undefined) {
      return;
    }
    let listing = this.#listing.get(node);
    if (listing === undefined) {
      if (this.#pages.has(page.offset)) {
        throw broken(this.facts.name, "a page of its list of nodes contains itself");
      }
      listing = this.#readPage(node, page).finally(() => this.#listing.delete(node));
      this.#listing.set(node, listing);
    }
    await listing;
  }

  async #readPage(node: OctreeNode, page: ByteRange): Promise<void> {
    await this.readPage(node, page);
    this.#pages.add(page.offset);
    this.#unread -= 1;
    const { name, points } = this.facts;
    if (this.#unread === 0 && this.#listed !== points) {
      throw broken(name, `its nodes list ${this.#listed} points, but its header gives ${points}`);
    }
  }

  /** Counts the points of nodes that were listed. */
  protected countListed(points: number): void {
    this.#listed += points;
    if (this.#listed > this.facts.points) {
      throw broken(this.facts.name, `its nodes list more points than the ${this.facts.points} of its header`);
    }
  }

  /** A node that is not listed yet. */
  protected node(key: string, depth: number, cell: Triple): OctreeNode {
    if (depth > DEEPEST) {
      throw broken(this.facts.name, `its octree is deeper than ${DEEPEST} levels`);
    }
    const nothing = { offset: 0, length: 0 };
    return {
      key,
      depth,
      cell,
      ...this.#boxOf(depth, cell),
      count: 0,
      part: nothing,
      children: [],
      page: undefined,
      pageLength: 0,
    };
  }

  /** Notes that a page of its own lists the node. */
  protected defer(node: OctreeNode, page: ByteRange): void {
    this.#unread += 1;
    node.page = page;
    node.pageLength = page.length;
  }

  /** The positions of integers, which must be in the node's box. */
  protected placed(node: OctreeNode, integers: Int32Array): Float64Array<ArrayBuffer> {
    const { scale, offset, name } = this.facts;
    const { min, max } = node;
    const positions = new Float64Array(integers.length);
    for (let i = 0; i < integers.length; i++) {
      const axis = i % 3;
      const value = integers[i]! * scale[axis]! + offset[axis]!;
      if (!(value >= min[axis]! && value <= max[axis]!)) {
        throw broken(name, `point ${Math.floor(i / 3)} of node ${node.key} lies outside of the node's box`);
      }
      positions[i] = value;
    }
    return positions;
  }

  #boxOf(depth: number, cell: Triple): Box {
    const { cube, bounds } = this.facts;
    const at = (axis: Axis, step: number) =>
      cube.min[axis] + (cube.max[axis] - cube.min[axis]) * ((cell[axis] + step) / 2 ** depth);
    const min = triple((axis) => Math.max(at(axis, 0), bounds?.min[axis] ?? -Infinity) - this.#tolerance[axis]);
    const max = triple((axis) => Math.min(at(axis, 1), bounds?.max[axis] ?? Infinity) + this.#tolerance[axis]);
    return { min, max };
  }
}

type Axis = 0 | 1 | 2;

export function triple(of: (axis: Axis) => number): Triple {
  return [of(0), of(1), of(2)];
}

/** The cell of a child. Bit 0 of the number is x, bit 1 is y, bit 2 is z. */
export function childCell([x, y, z]: Triple, number: number): Triple {
  return [2 * x + (number & 1), 2 * y + ((number >> 1) & 1), 2 * z + ((number >> 2) & 1)];
}

/** The node and all nodes below it that are known so far. */
export function* subtree(node: OctreeNode): Generator<OctreeNode> {
  const left = [node];
  for (let next = left.pop(); next !== undefined; next = left.pop()) {
    yield next;
    left.push(...next.children);
  }
}

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
