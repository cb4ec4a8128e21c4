/** Flat and round pieces of surface, from which the living room is built. */

export type Vector = [number, number, number];
export type Color = [number, number, number];

/** A piece of surface. */
export interface Surface {
  area: number;
  color: Color;
  /** The number of flat pieces along u and v if it becomes a mesh. A round surface has enough pieces to look round. */
  pieces: [number, number];
  /** A point of the surface and its normal; u and v go from 0 to 1. */
  at(u: number, v: number): { point: Vector; normal: Vector };
}

export function rectangle(corner: Vector, a: Vector, b: Vector, normal: Vector, color: Color): Surface {
  const area = Math.hypot(...a) * Math.hypot(...b);
  return {
    area,
    color,
    pieces: [1, 1],
    at: (u, v) => ({ point: corner.map((value, axis) => value + u * a[axis]! + v * b[axis]!) as Vector, normal }),
  };
}

export function box([x, y, z]: Vector, [w, h, d]: Vector, color: Color): Surface[] {
  return [
    rectangle([x, y, z], [w, 0, 0], [0, 0, d], [0, -1, 0], color),
    rectangle([x, y + h, z], [w, 0, 0], [0, 0, d], [0, 1, 0], color),
    rectangle([x, y, z], [0, h, 0], [0, 0, d], [-1, 0, 0], color),
    rectangle([x + w, y, z], [0, h, 0], [0, 0, d], [1, 0, 0], color),
    rectangle([x, y, z], [w, 0, 0], [0, h, 0], [0, 0, -1], color),
    rectangle([x, y, z + d], [w, 0, 0], [0, h, 0], [0, 0, 1], color),
  ];
}

/** Four legs under the corners of a box. */
export function legs([x, y, z]: Vector, [w, h, d]: Vector, thick: number, color: Color): Surface[] {
  const size: Vector = [thick, h, thick];
  return [
    ...box([x, y, z], size, color),
    ...box([x + w - thick, y, z], size, color),
    ...box([x, y, z + d - thick], size, color),
    ...box([x + w - thick, y, z + d - thick], size, color),
  ];
}

/** An upright cylinder or a truncated cone, open at both ends. */
export function cylinder([x, y, z]: Vector, bottom: number, top: number, height: number, color: Color): Surface {
  return {
    area: Math.PI * (bottom + top) * height,
    color,
    pieces: [64, 1],
    at(u, v) {
      const turn = 2 * Math.PI * u;
      const r = bottom + (top - bottom) * v;
      const normal: Vector = [Math.cos(turn), 0, Math.sin(turn)];
      return { point: [x + r * normal[0], y + height * v, z + r * normal[2]], normal };
    },
  };
}

export function sphere([x, y, z]: Vector, r: number, color: Color): Surface {
  return {
    area: 4 * Math.PI * r * r,
    color,
    pieces: [64, 32],
    at(u, v) {
      // By Archimedes, points that are even in height and in longitude are even on the sphere.
      const turn = 2 * Math.PI * u;
      const up = 2 * v - 1;
      const ring = Math.sqrt(1 - up * up);
      const normal: Vector = [ring * Math.cos(turn), up, ring * Math.sin(turn)];
      return { point: [x + r * normal[0], y + r * up, z + r * normal[2]], normal };
    },
  };
}

export function dot(a: Vector, b: Vector): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
