import { PointCloud } from "../cloud/cloud.js";
import type { NodeCache } from "./cache.js";
import { type OctreeNode, subtree, type Tree } from "./tree.js";

/** The spacing is measured in this many cells. */
const CELLS = 6;
/** A cell holds at least about this many points, so that few of them are at its border. */
const LEAST_POINTS = 4000;

/** The spacing of a whole cloud, estimated from parts of it. */
export interface Estimate {
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
export async function estimateSpacing(tree: Tree, cache: NodeCache, signal?: AbortSignal): Promise<Estimate> {
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
