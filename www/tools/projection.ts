import { Matrix4, type PerspectiveCamera } from "three";

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
