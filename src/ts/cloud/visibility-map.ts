import { addTag } from "../base/objects.js";
import { HprError } from "../base/errors.js";
import type { Answers } from "../query/queries.js";
import { type Positions, readPositions } from "../query/positions.js";
import { GLSL, WGSL } from "./visibility-shader.js";

/** The numbers of the shader, beside the texture `hprDepths`. */
export interface VisibilityMapUniforms {
  /** x, y, z of the viewpoint, relative to the map's origin. */
  readonly hprViewpoint: readonly [number, number, number];
  /** Cells a unit, the border of a cell, what 1/z adds to it, and the error of a distance. */
  readonly hprMargins: readonly [number, number, number, number];
}

const fround = Math.fround;

/**
 * A map of directions around a viewpoint. It tells which points are certainly hidden, in a shader or
 * here, for any number of points.
 */
export class VisibilityMap {
  /** x, y, z of the viewpoint, in the cloud's coordinates. */
  readonly viewpoint: readonly [number, number, number];
  /** x, y, z of the place that positions in a shader are relative to. */
  readonly origin: readonly [number, number, number];
  readonly uniforms: VisibilityMapUniforms;
  /** The middle of the cloud's box. @internal */
  readonly center: readonly [number, number, number];
  #data: Float32Array<ArrayBuffer> | undefined;

  static {
    addTag(this.prototype, "VisibilityMap");
  }

  /** @internal */
  constructor({ data, viewpoint, center, origin, numbers }: Answers["visibilityMap"]) {
    this.#data = data;
    this.viewpoint = viewpoint;
    this.center = center;
    this.origin = origin;
    const [x, y, z] = viewpoint;
    this.uniforms = {
      hprViewpoint: [fround(x - origin[0]), fround(y - origin[1]), fround(z - origin[2])],
      hprMargins: numbers,
    };
  }

  /**
   * The texture `hprDepths`: rows of 256 single-precision numbers (R32F, read with texelFetch). It is
   * empty where nothing is hidden.
   *
   * @throws HprError `disposed`.
   */
  get data(): Float32Array<ArrayBuffer> {
    if (this.#data === undefined) {
      throw new HprError("disposed", "this map was disposed of");
    }
    return this.#data;
  }

  /** The uniforms and `bool hidden(vec3 position)` for GLSL ES 3.00. */
  get glsl(): string {
    return GLSL;
  }

  /** `fn hidden(position: vec3f) -> bool` for WGSL, which reads `hprDepths`, `hprViewpoint` and `hprMargins`. */
  get wgsl(): string {
    return WGSL;
  }

  /**
   * Which places are certainly hidden, computed as a shader does.
   *
   * @param positions x, y, z of one place after another, in the cloud's coordinates.
   * @returns one byte for each place: 1 for hidden.
   * @throws HprError `positions-type`, `positions-length`, `disposed`.
   */
  hides(positions: Positions): Uint8Array<ArrayBuffer> {
    const { data } = this;
    const numbers = readPositions(positions, 3);
    const hidden = new Uint8Array(numbers.length / 3);
    const [ox, oy, oz] = this.origin;
    const [x, y, z] = this.uniforms.hprViewpoint;
    for (let i = 0; i < hidden.length && data.length > 0; i++) {
      const isHidden = hides(
        data,
        this.uniforms.hprMargins,
        fround(fround(numbers[3 * i]! - ox) - x),
        fround(fround(numbers[3 * i + 1]! - oy) - y),
        fround(fround(numbers[3 * i + 2]! - oz) - z),
      );
      hidden[i] = Number(isHidden);
    }
    return hidden;
  }

  /**
   * The numbers of the shader for positions in another space. `m` goes from there to the space of the
   * cloud: the elements of a matrix that turns, moves and scales by one factor. A shader turns
   * `position - viewpoint` by `turn` and tests it with `hprViewpoint` 0.
   *
   * The product is wrong by 9 units a coordinate, so a direction is wrong by 40 of them instead of 9. The
   * viewpoint is rounded in the other space.
   *
   * @internal
   */
  seenIn(m: readonly number[]): { viewpoint: number[]; turn: number[]; margins: number[] } {
    const turn = [0, 1, 2].map((axis) => m.slice(4 * axis, 4 * axis + 3));
    const squared = turn[0]!.reduce((sum, x) => sum + x * x, 0);
    const moved = this.viewpoint.map((x, axis) => x - m[12 + axis]!);
    const viewpoint = turn.map((row) => row.reduce((sum, x, axis) => sum + x * moved[axis]!, 0) / squared);
    const [cells, border, perDepth, error] = this.uniforms.hprMargins;
    const isTurned = turn.flat().some((x, i) => x !== Number(i % 4 === 0));
    const isMoved = isTurned || viewpoint.some((x, axis) => x !== this.viewpoint[axis]! - this.origin[axis]!);
    const largest = isMoved ? Math.max(...viewpoint.map(Math.abs)) * Math.sqrt(3 * squared) : 0;
    const grown = 1 + (2 * largest * 1.21e-7) / error;
    const borders = isTurned ? 3 * border : border;
    return { viewpoint, turn: turn.flat(), margins: [cells, borders, perDepth * grown, error * grown] };
  }

  /** Gives the texture's memory up. May be called twice. */
  dispose(): void {
    this.#data = undefined;
  }
}

/** The same numbers as `hides_at` of the core, of which each is rounded to single precision. */
function hides(
  data: Float32Array,
  [cells, atBorder, perDepth, error]: VisibilityMapUniforms["hprMargins"],
  vx: number,
  vy: number,
  vz: number,
): boolean {
  const [a, b, c] = [Math.abs(vx), Math.abs(vy), Math.abs(vz)];
  const axis = c >= a && c >= b ? 0 : a >= b ? 2 : 4;
  const [u, v, w] = axis === 0 ? [vx, vy, vz] : axis === 2 ? [vy, vz, vx] : [vz, vx, vy];
  const side = 8 * (axis + Number(w < 0));
  const inverse = fround(1 / Math.abs(w));
  const [x, y] = [fround(u * inverse), fround(v * inverse)];
  const right = fround(fround(x - data[side]!) * cells);
  const up = fround(fround(y - data[side + 1]!) * cells);
  const border = fround(atBorder + fround(perDepth * inverse));
  const [column, row] = [Math.floor(right), Math.floor(up)];
  const [s, t] = [fround(right - column), fround(up - row)];
  const last = fround(1 - border);
  const [columns, rows] = [data[side + 2]!, data[side + 3]!];
  const isKnown = column >= 0 && row >= 0 && column < columns && row < rows;
  if (!(isKnown && s > border && s < last && t > border && t < last)) return false;
  const low = data[side + 4]! + row * (columns + 1) + column;
  const high = low + columns + 1;
  const [p, q, m, n] = [data[low]!, data[low + 1]!, data[high]!, data[high + 1]!];
  const mix = (from: number, to: number, part: number) => fround(fround(from * fround(1 - part)) + fround(to * part));
  const most = Math.max(p, q, m, n);
  const range = fround(fround(most - Math.min(p, q, m, n)) * fround(2 * border));
  const limit = fround(fround(mix(mix(p, q, s), mix(m, n, s), t) + range) + fround(most * fround(4e-6)));
  const squared = fround(fround(fround(x * x) + fround(y * y)) + 1);
  const length = fround(Math.abs(w) * fround(Math.sqrt(squared)));
  return most < 1e30 && length < Infinity && fround(fround(length * fround(1 - 8e-6)) - error) > limit;
}
