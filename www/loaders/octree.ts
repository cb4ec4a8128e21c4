import { init } from "hidden-point-removal";
import { openOctree } from "hidden-point-removal/stream";
import { displayScale } from "../../src/ts/formats/colors.js";
import type { LoadedCloud } from "../cloud/cloud.ts";
import { compileFiles } from "./download.ts";
import { decimalsOf } from "./loaded.ts";

const number = new Intl.NumberFormat("en-US");

/**
 * The coarser levels of a cloud-optimized point cloud (COPC) of more than `limit` points. Null if it has fewer, or cannot be
 * read in parts: then it is read as any LAZ file, which says what is wrong.
 */
export async function coarseOf(name: string, from: string | Blob, limit: number): Promise<LoadedCloud | null> {
  const [wasm] = await Promise.all([compileFiles(name), init()]);
  const octree = await openOctree(from, { wasm, colors: true, retries: 0 }).catch(() => null);
  if (octree === null || octree.points <= limit) return null;
  const { positions, colors } = await octree.coarse(limit);
  const scale = colors ? displayScale([colors]) : 0;
  const { points, crs, grid } = octree;
  octree.dispose();
  return {
    positions,
    colors:
      colors && scale > 0 ? new Uint8Array(Uint8ClampedArray.from(colors, (value) => value * scale).buffer) : null,
    attributes: [],
    fields: [],
    facts: { ...decimalsOf(grid), ...(crs && { crs }) },
    notes: [
      `Of its ${number.format(points)} points, the ${number.format(positions.length / 3)} points of its coarser levels are shown, without attributes.`,
    ],
  };
}
