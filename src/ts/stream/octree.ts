import { HprError } from "../base/errors.js";
import { concatenated } from "../base/memory.js";
import { PointCloud } from "../cloud/cloud.js";
import type { MergeOptions } from "../cloud/merge.js";
import type { Crs } from "../formats/las/crs.js";
import { untilAborted } from "../worker/abort.js";
import { NodeCache } from "./cache.js";
import { openCopc } from "./copc.js";
import { Look, type OctreeStep } from "./look.js";
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
import { type Estimate, estimateSpacing } from "./spacing.js";
import type { Box, NodePoints, OctreeNode, Tree, Triple } from "./tree.js";

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
  visibleFrom(viewpoint: ArrayLike<number>, options?: OctreeViewOptions): AsyncGenerator<OctreeStep, void, undefined> {
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
    yield* new Look(this.#tree, this.#cache, request, merge, isMeasured ? 0 : bytes).steps();
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
