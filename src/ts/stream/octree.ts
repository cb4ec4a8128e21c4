import { concatenated, HprError } from "../base/errors.js";
import { PointCloud } from "../cloud/cloud.js";
import type { MergeOptions } from "../cloud/merge.js";
import type { Crs } from "../formats/las/crs.js";
import type { Viewpoint } from "../query/positions.js";
import { untilAborted } from "../worker/abort.js";
import { openCopc } from "./copc.js";
import {
  type OctreeOptions,
  type OctreeSettings,
  octreeSettings,
  type OctreeViewOptions,
  viewRequest,
  type ViewRequest,
} from "./options.js";
import { openPotree } from "./potree.js";
import { filesOf, type PotreeFiles, type RangeReader } from "./source.js";
import { type Box, NodeCache, type NodePoints, type OctreeNode, subtree, type Tree, type Triple } from "./tree.js";
import { OctreeView, type OctreeStep } from "./view.js";

/** The spacing is measured in this many cells. */
const CELLS = 6;
/** A cell holds at least about this many points, so that few of them are at its border. */
const LEAST_POINTS = 4000;

/** The spacing of a whole cloud, estimated from parts of it. */
interface Estimate {
  spacing: number;
  /** The number of bytes that were read for it. */
  bytes: number;
}

/**
 * Estimates the spacing of the whole cloud: the mean distance of a point to its 6 nearest ones.
 *
 * All points of the cloud that lie in the cell of a node are in that node, in the nodes below it and
 * in those above it. So the spacing can be measured in a few cells. Each is chosen as often as the
 * number of its points says, and the same cells are chosen each time.
 */
async function estimateSpacing(tree: Tree, cache: NodeCache, signal?: AbortSignal): Promise<Estimate> {
  const means: number[] = [];
  let bytes = 0;
  if (tree.facts.points === 0) {
    return { spacing: 0, bytes };
  }
  for (let cell = 0; cell < CELLS; cell++) {
    const path = await pathTo(tree, (cell + 0.5) / CELLS);
    const bottom = path.at(-1)!;
    const chosen: number[] = [];
    for (const node of [...path.slice(0, -1), ...subtree(bottom)]) {
      const loaded = await cache.load(node, signal);
      bytes += loaded.bytes;
      addWithin(bottom, loaded.positions, chosen);
    }
    const cloud = new PointCloud(chosen);
    means.push(cloud.spacing);
    cloud.dispose();
  }
  return { spacing: means.reduce((sum, mean) => sum + mean, 0) / means.length, bytes };
}

/** The nodes from the root down to the cell at a share of all points. Lists the nodes on its way. */
async function pathTo(tree: Tree, share: number): Promise<OctreeNode[]> {
  const path = [tree.root];
  for (;;) {
    const node = path.at(-1)!;
    await tree.list(node);
    const byByte = pointsByByte(tree.root);
    const weights = node.children.map((child) => weightOf(child, byByte));
    const large = weights.map((weight) => (weight >= LEAST_POINTS ? weight : 0));
    let left = share * large.reduce((sum, weight) => sum + weight, 0);
    const number = large.findIndex((weight) => weight > 0 && (left -= weight) < 0);
    if (number < 0) {
      await listBelow(tree, node);
      return path;
    }
    // The same share, within the child.
    share = Math.min(Math.max(1 + left / large[number]!, 0), 1 - Number.EPSILON);
    path.push(node.children[number]!);
  }
}

/**
 * The number of points in a node and below it. A node with a page of its own counts by the length of
 * the page, whether it was read or not. So the cells do not depend on what was read before.
 */
function weightOf({ pageLength, count, children }: OctreeNode, byByte: number): number {
  return pageLength > 0 ? pageLength * byByte : children.reduce((sum, child) => sum + weightOf(child, byByte), count);
}

/** How many points a byte of a page stands for, as the first page shows. */
function pointsByByte(root: OctreeNode): number {
  return root.children.reduce((sum, child) => sum + pointsInPage(child), root.count) / root.pageLength;
}

function pointsInPage({ pageLength, count, children }: OctreeNode): number {
  return pageLength > 0 ? 0 : children.reduce((sum, child) => sum + pointsInPage(child), count);
}

async function listBelow(tree: Tree, top: OctreeNode): Promise<void> {
  for (const node of subtree(top)) {
    await tree.list(node);
  }
}

function addWithin({ min, max }: OctreeNode, positions: Float64Array, chosen: number[]): void {
  for (let i = 0; i < positions.length; i += 3) {
    const [x, y, z] = [positions[i]!, positions[i + 1]!, positions[i + 2]!];
    if (x >= min[0] && x <= max[0] && y >= min[1] && y <= max[1] && z >= min[2] && z <= max[2]) {
      chosen.push(x, y, z);
    }
  }
}

/** The number of nodes of the coarsest levels that are fetched at the same time. */
const AT_ONCE = 6;

/**
 * Opens an octree of points, without reading its points: COPC or Potree 2 (uncompressed).
 *
 * ```js
 * const octree = await openOctree("https://example.org/city.copc.laz");
 * for await (const step of octree.visibleFrom([100, 200, 1.7])) {
 *   draw(step.positions()); // coarse at once, then more and more nodes
 *   console.log(step.exact ? "exact" : `${step.nodes.undecided} nodes undecided`);
 * }
 * ```
 *
 * @param source the address of a COPC file or of Potree's `metadata.json`, a Blob or a function that
 *   reads ranges of a COPC file, or readers of Potree's files. Servers must answer range requests.
 * @throws HprError (as a rejection) `option`, `load` (cannot be fetched, or is broken).
 */
export async function openOctree(
  source: string | URL | Blob | RangeReader | PotreeFiles,
  options?: OctreeOptions,
): Promise<Octree> {
  const settings = octreeSettings(options);
  const files = await filesOf(source, settings);
  const tree =
    files.format === "copc"
      ? await openCopc(files.name, files.read, settings)
      : openPotree(files.name, files, settings.colors);
  return new Octree(tree, settings);
}

/** An octree of points, of which only the nodes that a view needs are read. */
export class Octree {
  readonly #tree: Tree;
  readonly #cache: NodeCache;
  #estimate: Promise<Estimate> | undefined;
  #isDisposed = false;

  /** @internal Call `openOctree`. */
  constructor(tree: Tree, settings: OctreeSettings) {
    this.#tree = tree;
    this.#cache = new NodeCache(tree, settings.cache);
  }

  /** The number of points of all nodes. */
  get points(): number {
    return this.#tree.facts.points;
  }

  /** The box of all points, as the file gives it. It may be larger than the points need. */
  get bounds(): Box {
    return this.#tree.facts.bounds ?? this.#tree.facts.cube;
  }

  /** A coordinate is an integer times the scale, plus the offset: for each axis. */
  get grid(): { readonly scale: Triple; readonly offset: Triple } {
    const { scale, offset } = this.#tree.facts;
    return { scale, offset };
  }

  /** The coordinate reference system, if the file names one. */
  get crs(): Crs | undefined {
    return this.#tree.facts.crs;
  }

  /** The number of points that are kept for the next views. */
  get cached(): number {
    return this.#cache.points;
  }

  /**
   * Finds the points that are visible from a viewpoint, as those of one cloud with all points.
   *
   * The nodes that look largest are read first. A node is not fetched if the points so far hide its
   * whole box, nor are the nodes below it. Each step is computed from the nodes so far: it shows more
   * nodes, and hides more points. The last step is exact unless the budget was too small. A step that
   * was not asked for is not computed.
   *
   * @param viewpoint x, y, z in the units of the octree.
   * @throws HprError at once: `viewpoint`, `option`, `radius`, `disposed`; while it is iterated: `load`
   *   (a node cannot be fetched, or is broken), `radius` (a point is farther than the radius),
   *   `not-initialised`, `too-large`, `internal`.
   */
  visibleFrom(viewpoint: Viewpoint, options?: OctreeViewOptions): AsyncGenerator<OctreeStep, void, undefined> {
    this.#requireOpen();
    return this.#steps(viewRequest(viewpoint, options));
  }

  /**
   * The points of the coarsest levels, which are spread evenly: of the first one, and of as many more as there are
   * without exceeding `most` points.
   *
   * @throws HprError (as a rejection) `load`, `disposed`, `too-large`.
   */
  async coarse(most: number): Promise<NodePoints> {
    this.#requireOpen();
    const chosen: OctreeNode[] = [];
    let points = 0;
    for (let level = [this.#tree.root]; level.length > 0; level = level.flatMap(({ children }) => children)) {
      for (const node of level) await this.#tree.list(node);
      points += level.reduce((sum, { count }) => sum + count, 0);
      if (chosen.some(({ count }) => count > 0) && points > most) break;
      chosen.push(...level);
    }
    const parts: NodePoints[] = [];
    for (let i = 0; i < chosen.length; i += AT_ONCE) {
      parts.push(...(await Promise.all(chosen.slice(i, i + AT_ONCE).map((node) => this.#cache.load(node)))));
    }
    const positions = concatenated(parts.map((part) => part.positions));
    const colors = parts.some((part) => part.colors) ? new Uint16Array(positions.length) : undefined;
    let at = 0;
    for (const part of parts) {
      if (part.colors) colors!.set(part.colors, at);
      at += part.positions.length;
    }
    return { positions, colors };
  }

  /**
   * The spacing of the cloud, estimated from some of its nodes: the mean distance of a point to its 6
   * nearest ones. The automatic inversion is made from it. It is measured once.
   *
   * @throws HprError (as a rejection) `load`, `not-initialised`, `disposed`, `too-large`.
   */
  async spacing(): Promise<number> {
    this.#requireOpen();
    return (await this.#measure()).spacing;
  }

  /** Frees the memory of the kept nodes. May be called twice. */
  dispose(): void {
    this.#isDisposed = true;
    this.#cache.close();
  }

  async *#steps(request: ViewRequest): AsyncGenerator<OctreeStep, void, undefined> {
    const isMeasured = this.#estimate !== undefined;
    const { spacing, bytes } = request.merge
      ? { spacing: 0, bytes: 0 }
      : await untilAborted(request.signal, this.#measure());
    const merge = request.merge ?? automatic(spacing);
    yield* new OctreeView(this.#tree, this.#cache, request, merge, isMeasured ? 0 : bytes).steps();
  }

  #measure(): Promise<Estimate> {
    this.#estimate ??= estimateSpacing(this.#tree, this.#cache).catch((error: unknown) => {
      // The next view tries again.
      this.#estimate = undefined;
      throw error;
    });
    return this.#estimate;
  }

  #requireOpen(): void {
    if (this.#isDisposed) {
      throw new HprError("disposed", "this octree has been disposed of");
    }
  }
}

/** The exponential inversion that the core chooses for a cloud with this spacing. */
function automatic(spacing: number): MergeOptions {
  const cloud = new PointCloud([0, 0, 0, 1, 0, 0]);
  const { inversion } = cloud.visibleFrom([0, 0, 3], { inversion: { exponential: "auto" } });
  const scale = ((inversion as { exponential: number }).exponential / cloud.spacing) * spacing;
  cloud.dispose();
  return { inversion: { exponential: spacing > 0 ? Math.max(scale, Number.MIN_VALUE) : 1 } };
}
