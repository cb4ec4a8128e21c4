import { Matrix4, type PerspectiveCamera } from "three";
import { localSpacing } from "../cloud/prepare.ts";
import { MOST_PIXELS } from "../view/points.ts";
import type { Viewer } from "../view/viewer.ts";

/** A box in CSS pixels from the picture's left and top. */
export interface Box {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

/** Computes the places of points in the picture, in CSS pixels from its left and top. */
export class Projection {
  x = 0;
  y = 0;
  /** The distance ahead of the camera. */
  ahead = 0;
  readonly #local: Float32Array;
  readonly #matrix: Matrix4["elements"];
  readonly #width: number;
  readonly #height: number;
  /** The length of a unit at distance 1, in pixels. */
  readonly #pixels: number;

  constructor(local: Float32Array, camera: PerspectiveCamera, { width, height }: { width: number; height: number }) {
    this.#local = local;
    this.#matrix = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).elements;
    this.#width = width;
    this.#height = height;
    this.#pixels = (camera.projectionMatrix.elements[5] * height) / 2;
  }

  /** Goes to a point. Returns `false` if the point is behind the camera or out of the picture. */
  to(index: number): boolean {
    const m = this.#matrix;
    const x = this.#local[3 * index]!;
    const y = this.#local[3 * index + 1]!;
    const z = this.#local[3 * index + 2]!;
    this.ahead = m[3] * x + m[7] * y + m[11] * z + m[15];
    if (this.ahead <= 0) return false;
    this.x = (0.5 + (0.5 * (m[0] * x + m[4] * y + m[8] * z + m[12])) / this.ahead) * this.#width;
    this.y = (0.5 - (0.5 * (m[1] * x + m[5] * y + m[9] * z + m[13])) / this.ahead) * this.#height;
    return this.x >= 0 && this.y >= 0 && this.x <= this.#width && this.y <= this.#height;
  }

  /** Goes to each of these points (`null`: of all points) that is in the picture and in this box. */
  each(box: Box, indices: Uint32Array | null, visit: (index: number) => void): void {
    const local = this.#local;
    const width = this.#width;
    const height = this.#height;
    const [a, b, , d, e, f, , h, i, j, , l, m, n, , p] = this.#matrix;
    // The box is in shares of the picture from its middle. It is multiplied by the distance ahead for each point, so
    // that points outside it need no division.
    const [left, right] = [Math.max(-1, (2 * box.left) / width - 1), Math.min(1, (2 * box.right) / width - 1)];
    const [top, bottom] = [Math.min(1, 1 - (2 * box.top) / height), Math.max(-1, 1 - (2 * box.bottom) / height)];
    const count = indices ? indices.length : local.length / 3;
    for (let k = 0; k < count; k++) {
      const index = indices ? indices[k]! : k;
      const x = local[3 * index]!;
      const y = local[3 * index + 1]!;
      const z = local[3 * index + 2]!;
      const ahead = d * x + h * y + l * z + p;
      const across = a * x + e * y + i * z + m;
      if (across < left * ahead || across > right * ahead) continue;
      const up = b * x + f * y + j * z + n;
      if (up < bottom * ahead || up > top * ahead) continue;
      if (ahead <= 0) continue;
      this.ahead = ahead;
      this.x = (0.5 + (0.5 * across) / ahead) * width;
      this.y = (0.5 - (0.5 * up) / ahead) * height;
      visit(index);
    }
  }

  /** The length in the cloud that covers this number of pixels at the point's distance. */
  lengthOf(pixels: number): number {
    return (pixels * this.ahead) / this.#pixels;
  }
}

/** A place in the picture, in CSS pixels from its left and top, and the largest distance of a point from it. */
export interface Spot {
  x: number;
  y: number;
  tolerance: number;
}

/** A point belongs to another surface if it lies more than this many tolerances behind the nearest point. */
const LAYER = 4;

/**
 * Finds the point that the user means at a spot. Of the points within the tolerance, only the points on the surface
 * nearest to the camera count. The one nearest to the spot is taken. If there is no point within the tolerance, points
 * that cover the spot because they are drawn large count as well.
 */
export function pointAt(viewer: Viewer, { x, y, tolerance }: Spot, through: boolean): number | null {
  const { pointWidth, pixelRatio } = viewer.stage;
  const { local } = viewer.scene.cloud.spacing;
  const widest = MOST_PIXELS / 2 / pixelRatio;
  const among = through ? null : viewer.scene.visible;
  return (
    nearestAt(viewer, x, y, among, tolerance, () => tolerance) ??
    nearestAt(viewer, x, y, among, widest, (at, index) =>
      Math.min(widest, (localSpacing(local[index]!) * pointWidth) / 2 / at.lengthOf(1)),
    )
  );
}

/** Finds the nearest point at a distance of at most `allowed` from (x, y). `allowed` is never more than `most`. */
function nearestAt(
  viewer: Viewer,
  x: number,
  y: number,
  among: Uint32Array | null,
  most: number,
  allowed: (at: Projection, index: number) => number,
): number | null {
  const found: { index: number; off: number; ahead: number }[] = [];
  let behind = Infinity;
  const at = new Projection(viewer.scene.cloud.local, viewer.stage.camera, viewer.stage.size);
  // The box is a little larger than the circle. Points near the rim are decided below.
  const reach = most + 1;
  at.each({ left: x - reach, right: x + reach, top: y - reach, bottom: y + reach }, among, (index) => {
    const off = Math.hypot(at.x - x, at.y - y);
    const tolerance = allowed(at, index);
    if (off > tolerance) return;
    found.push({ index, off, ahead: at.ahead });
    behind = Math.min(behind, at.ahead + at.lengthOf(LAYER * tolerance));
  });
  const near = found.filter(({ ahead }) => ahead <= behind);
  if (near.length === 0) return null;
  return near.reduce((best, point) => (point.off < best.off ? point : best)).index;
}

/** The visible points, or all points, within a closed line, ascending. */
export function pointsWithin(viewer: Viewer, line: readonly { x: number; y: number }[], through: boolean): Uint32Array {
  const { cloud, visible } = viewer.scene;
  const at = new Projection(cloud.local, viewer.stage.camera, viewer.stage.size);
  const [xs, ys] = [line.map(({ x }) => x), line.map(({ y }) => y)];
  const box = { left: Math.min(...xs), right: Math.max(...xs), top: Math.min(...ys), bottom: Math.max(...ys) };
  const found: number[] = [];
  at.each(box, through ? null : visible, (index) => {
    if (isInside(line, at)) found.push(index);
  });
  return Uint32Array.from(found);
}

/** A ray to the right from a place inside crosses the line an odd number of times. */
function isInside(line: readonly { x: number; y: number }[], { x, y }: { x: number; y: number }): boolean {
  let inside = false;
  for (let i = 0, j = line.length - 1; i < line.length; j = i++) {
    const [a, b] = [line[i]!, line[j]!];
    if (a.y > y !== b.y > y && x < a.x + ((y - a.y) * (b.x - a.x)) / (b.y - a.y)) inside = !inside;
  }
  return inside;
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
