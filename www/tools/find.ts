import type { Viewer } from "../viewer.ts";
import { Projection } from "./projection.ts";

/** A place in the picture, in CSS pixels from its left and top, and how many of them a point may be off. */
export interface Spot {
  x: number;
  y: number;
  tolerance: number;
}

/** Points further behind the nearest than so many tolerances are another surface. */
const LAYER = 4;

/** The point that is meant at a spot: of those within the tolerance that nearest to the spot, on the surface nearest to the camera. */
export function pointAt(viewer: Viewer, { x, y, tolerance }: Spot, through: boolean): number | null {
  const found: { index: number; off: number; ahead: number }[] = [];
  let behind = Infinity;
  forEachCandidate(viewer, through, (index, at) => {
    const off = Math.hypot(at.x - x, at.y - y);
    if (off > tolerance) return;
    found.push({ index, off, ahead: at.ahead });
    behind = Math.min(behind, at.ahead + at.lengthOf(LAYER * tolerance));
  });
  const near = found.filter(({ ahead }) => ahead <= behind);
  if (near.length === 0) return null;
  return near.reduce((best, point) => (point.off < best.off ? point : best)).index;
}

/** All points within a closed line, ascending. */
export function pointsWithin(viewer: Viewer, line: readonly { x: number; y: number }[], through: boolean): Uint32Array {
  const xs = line.map(({ x }) => x);
  const ys = line.map(({ y }) => y);
  const [left, right, top, bottom] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const found: number[] = [];
  forEachCandidate(viewer, through, (index, { x, y }) => {
    if (x < left || x > right || y < top || y > bottom) return;
    // Odd: a ray to the right leaves the line once more than it enters.
    let inside = false;
    for (let i = 0, j = line.length - 1; i < line.length; j = i++) {
      const [a, b] = [line[i]!, line[j]!];
      if (a.y > y !== b.y > y && x < a.x + ((y - a.y) * (b.x - a.x)) / (b.y - a.y)) inside = !inside;
    }
    if (inside) found.push(index);
  });
  return Uint32Array.from(found);
}

/** Whether a point is among the ascending indices. */
export function includes(indices: Uint32Array, index: number): boolean {
  let low = 0;
  let high = indices.length;
  while (low < high) {
    const middle = (low + high) >>> 1;
    if (indices[middle]! < index) low = middle + 1;
    else high = middle;
  }
  return indices[low] === index;
}

/** The visible points, or all, that are in the picture. */
function forEachCandidate(viewer: Viewer, through: boolean, visit: (index: number, at: Projection) => void): void {
  const { cloud, visible } = viewer.scene;
  const at = new Projection(cloud.local, viewer.stage.camera, viewer.stage.size);
  const count = through ? cloud.count : visible.length;
  for (let i = 0; i < count; i++) {
    const index = through ? i : visible[i]!;
    if (at.to(index)) visit(index, at);
  }
}
