// Decides whether the library or a peer is right where they differ. Peers decide within a tolerance.
// It follows the definition itself, for one point, with every sign in exact integers.

type Exact = readonly [bigint, bigint, bigint];
type Face = readonly [number, number, number];

/** Flipped points, and the tools to decide about some of them. */
export class Arbiter {
  readonly #q: Float64Array;
  /** Every coordinate is an integer times 2 to this power. */
  readonly #unit: number;

  constructor(q: Float64Array) {
    this.#q = q;
    this.#unit = q.reduce((least, x) => (x === 0 ? least : Math.min(least, decoded(x).exponent)), Infinity);
  }

  /**
   * Is point p on the outer boundary of the hull of all points and the origin? Walks over
   * planes through three points to the plane where the ray through p leaves the hull. This
   * is the simplex method. It starts from a face of p, so that no tie can make it cycle.
   */
  visible(p: number): boolean {
    const start = this.#facing(p);
    let face = start;
    while (this.#height(face, p) >= 0n) {
      const beyond = this.#beyond(face);
      if (beyond === undefined) return true;
      const [a, b, c] = face;
      const faces: Face[] = [[beyond, b, c], [a, beyond, c], [a, b, beyond]]; // prettier-ignore
      face = faces.find((next) => this.#holds(next, start))!;
    }
    return false;
  }

  #exact(i: number): Exact {
    const at = (axis: number): bigint => {
      const x = this.#q[3 * i + axis]!;
      if (x === 0) return 0n;
      const { mantissa, exponent } = decoded(x);
      return mantissa << BigInt(exponent - this.#unit);
    };
    return [at(0), at(1), at(2)];
  }

  /** Point p and two points far from it and from each other, counter-clockwise. */
  #facing(p: number): Face {
    const q = this.#q;
    const [px, py, pz] = [q[3 * p]!, q[3 * p + 1]!, q[3 * p + 2]!];
    const cross = (i: number): [number, number, number] => {
      const [x, y, z] = [q[3 * i]!, q[3 * i + 1]!, q[3 * i + 2]!];
      return [py * z - pz * y, pz * x - px * z, px * y - py * x];
    };
    const a = this.#largest((i) => Math.hypot(...cross(i)));
    const [nx, ny, nz] = cross(a);
    const b = this.#largest((i) => Math.abs(q[3 * i]! * nx + q[3 * i + 1]! * ny + q[3 * i + 2]! * nz));
    return det(this.#exact(p), this.#exact(a), this.#exact(b)) > 0n ? [p, a, b] : [p, b, a];
  }

  #largest(measure: (i: number) => number): number {
    let [best, most] = [0, -1];
    for (let i = 0; 3 * i < this.#q.length; i++) {
      const value = measure(i);
      if (value > most) [best, most] = [i, value];
    }
    return best;
  }

  /** Above 0 where point x is beyond the plane of the face, seen from the origin. */
  #height(face: Face, x: number): bigint {
    const [a, b, c] = face.map((i) => this.#exact(i)) as [Exact, Exact, Exact];
    const e = this.#exact(x);
    return det(e, b, c) + det(a, e, c) + det(a, b, e) - det(a, b, c);
  }

  /** A point beyond the plane of the face, the farthest first. */
  #beyond(face: Face): number | undefined {
    const q = this.#q;
    const at = (i: number): number[] => [...q.subarray(3 * i, 3 * i + 3)];
    const [a, b, c] = face.map(at) as [number[], number[], number[]];
    const [ux, uy, uz] = b.map((x, axis) => x - a[axis]!) as [number, number, number];
    const [vx, vy, vz] = c.map((x, axis) => x - a[axis]!) as [number, number, number];
    const n = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx] as const;
    const distance = n[0] * a[0]! + n[1] * a[1]! + n[2] * a[2]!;
    const above: [number, number][] = [];
    for (let i = 0; 3 * i < q.length; i++) {
      const height = (q[3 * i]! * n[0] + q[3 * i + 1]! * n[1] + q[3 * i + 2]! * n[2]) / distance - 1;
      // This is far outside the error of f64 for any face of this walk. Nearer points are decided exactly.
      if (height > -NEAR && !face.includes(i)) above.push([height, i]);
    }
    above.sort(([x], [y]) => y - x);
    return above.find(([, i]) => this.#height(face, i) > 0n)?.[1];
  }

  /** Whether the ray goes through this face. The ray is first moved a little towards the points of the face `start`. */
  #holds([a, b, c]: Face, start: Face): boolean {
    const exact = ([i, j, k]: Face): bigint => det(this.#exact(i), this.#exact(j), this.#exact(k));
    const turns = (u: number, v: number): boolean => {
      const signs = start.map((s) => exact([s, u, v]));
      return (signs.find((sign) => sign !== 0n) ?? 0n) > 0n;
    };
    return exact([a, b, c]) > 0n && turns(a, b) && turns(b, c) && turns(c, a);
  }
}

const NEAR = 1e-6;

function det([ax, ay, az]: Exact, [bx, by, bz]: Exact, [cx, cy, cz]: Exact): bigint {
  return ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
}

const word = new DataView(new ArrayBuffer(8));

/** x = mantissa · 2^exponent. */
function decoded(x: number): { mantissa: bigint; exponent: number } {
  word.setFloat64(0, x);
  const bits = word.getBigUint64(0);
  const biased = Number((bits >> 52n) & 0x7ffn);
  const fraction = bits & 0xfffffffffffffn;
  const mantissa = biased === 0 ? fraction : fraction | 0x10000000000000n;
  return { mantissa: x < 0 ? -mantissa : mantissa, exponent: Math.max(biased, 1) - 1075 };
}
