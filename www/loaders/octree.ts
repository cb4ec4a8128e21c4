import { init } from "hidden-point-removal";
import { openOctree } from "hidden-point-removal/stream";
import { displayScale } from "../../src/ts/formats/colors.js";
import type { LoadedCloud } from "../cloud/cloud.ts";
import { compileFiles } from "./download.ts";
import { decimalsOf } from "./loaded.ts";

/** The most points that are shown of a streamed octree while the camera moves: soon read, and soon answered. */
const OVERVIEW = 1_000_000;
/** The most points that may be visible from one viewpoint of a streamed octree, with those that are being read. */
const BUDGET = 4_000_000;

const number = new Intl.NumberFormat("en-US");

/**
 * The coarser levels of a cloud-optimized point cloud (COPC) with more points than `streamFrom`: the stream reads the
 * others. Null if it has fewer, or cannot be read in parts: then it is read as any LAZ file, which says what is wrong.
 */
export async function overviewOf(
  name: string,
  from: string | Blob,
  { limit, streamFrom }: { limit: number; streamFrom: number },
): Promise<LoadedCloud | null> {
  const [wasm] = await Promise.all([compileFiles(name), init()]);
  const octree = await openOctree(from, { wasm, colors: true, retries: 0 }).catch(() => null);
  if (octree === null || octree.points <= streamFrom) return null;
  const { positions, colors } = await octree.coarse(Math.min(limit, streamFrom, OVERVIEW));
  const scale = colors ? displayScale([colors]) : 0;
  const { points, crs, grid } = octree;
  octree.dispose();
  return {
    positions,
    // The overview and the other levels have the same factor, even if some points have dark colors alone.
    colors:
      colors && scale > 0 ? new Uint8Array(Uint8ClampedArray.from(colors, (value) => value * scale).buffer) : null,
    attributes: [],
    fields: [],
    facts: { ...decimalsOf(grid), ...(crs && { crs }) },
    streamed: { from, name, points, budget: Math.min(limit, BUDGET), colorScale: scale > 0 ? scale : null },
    notes: [
      `Its ${number.format(points)} points are read as they are needed. While the camera moves, ${number.format(positions.length / 3)} points of its coarser levels are shown. When it rests, all that is visible is read, without attributes.`,
    ],
  };
}
