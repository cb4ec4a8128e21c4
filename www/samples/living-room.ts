import type { LoadedCloud } from "../cloud/cloud.ts";

/*
 * A living room of 6 × 2.7 × 4.6 meters as a scanner might leave it: points spread evenly over every surface, two
 * millimeters of noise, muted colors with soft baked light. y is up, the floor is y = 0, the middle is x = z = 0.
 * A fixed seed: the same points on every machine.
 */

type Vector = [number, number, number];
type Color = [number, number, number];

/** A piece of surface: how large it is, and a point on it with its normal for two numbers in 0 … 1. */
export interface Surface {
  area: number;
  color: Color;
  /** By how many flat pieces along u and v it is told well enough from a round one. */
  pieces: [number, number];
  at(u: number, v: number): { point: Vector; normal: Vector };
}

const POINTS = 300_000;
const NOISE = 0.002;
const LIGHT: Vector = [0.45, 0.8, 0.4];

const PLASTER: Color = [214, 208, 198];
const CEILING: Color = [224, 222, 217];
const OAK: Color = [176, 142, 104];
const WALNUT: Color = [122, 88, 62];
const FABRIC: Color = [88, 118, 128];
const CUSHION: Color = [206, 158, 92];
const RUG: Color = [150, 84, 72];
const LEAF: Color = [92, 132, 84];
const CLAY: Color = [180, 104, 76];
const BRASS: Color = [190, 160, 96];
const LINEN: Color = [236, 224, 196];
const BOOKS: Color[] = [[146, 74, 66], [72, 96, 128], [196, 172, 120], [86, 116, 96], [120, 96, 120], [206, 200, 188]]; // prettier-ignore

export function makeRoom(): LoadedCloud {
  const positions = new Float32Array(3 * POINTS);
  const colors = new Uint8Array(3 * POINTS);
  let i = 0;
  for (const { surface, u, v, off, grain } of scanRoom().places) {
    const { point, normal } = surface.at(u, v);
    const light = 0.72 + 0.28 * Math.max(0, dot(normal, LIGHT)) + 0.05 * (grain - 0.5);
    for (let axis = 0; axis < 3; axis++) {
      positions[3 * i + axis] = point[axis]! + off * normal[axis]!;
      colors[3 * i + axis] = Math.min(255, surface.color[axis]! * light);
    }
    i++;
  }
  return { positions, colors };
}

/** Where a point is on its surface, how far off it is measured, and a number from 0 to 1 of its own. */
interface Place {
  surface: Surface;
  u: number;
  v: number;
  off: number;
  grain: number;
}

/** All surfaces of the room, and the places of its points on them, surface after surface. */
export function scanRoom(): { surfaces: Surface[]; places: Iterable<Place> } {
  const random = mulberry32(20070802);
  const surfaces = roomSurfaces(random);
  return { surfaces, places: scatter(surfaces, random) };
}

function* scatter(surfaces: readonly Surface[], random: () => number): Generator<Place> {
  const total = surfaces.reduce((sum, surface) => sum + surface.area, 0);
  let area = 0;
  let i = 0;
  for (const surface of surfaces) {
    area += surface.area;
    // Rounding the running sum gives exactly POINTS in all.
    const end = Math.round((area / total) * POINTS);
    let u = random();
    let v = random();
    for (; i < end; i++) {
      const here = { u, v };
      // M. Roberts' R2 sequence fills a square evenly, as a scanner would; independent random points leave holes.
      u = (u + 0.7548776662466927) % 1;
      v = (v + 0.5698402909980532) % 1;
      yield { surface, ...here, off: NOISE * (random() + random() + random() - 1.5), grain: random() };
    }
  }
}

/** All there is in the room; `random` decides about books and leaves. */
export function roomSurfaces(random: () => number): Surface[] {
  return [...shell(), ...furniture(random)];
}

function shell(): Surface[] {
  return [
    rectangle([-3, 0, -2.3], [6, 0, 0], [0, 0, 4.6], [0, 1, 0], OAK),
    rectangle([-3, 2.7, -2.3], [6, 0, 0], [0, 0, 4.6], [0, -1, 0], CEILING),
    // The back wall has a window of 1.8 × 1.3 m, seen as a hole with a frame.
    rectangle([-3, 0, -2.3], [1.5, 0, 0], [0, 2.7, 0], [0, 0, 1], PLASTER),
    rectangle([0.3, 0, -2.3], [2.7, 0, 0], [0, 2.7, 0], [0, 0, 1], PLASTER),
    rectangle([-1.5, 0, -2.3], [1.8, 0, 0], [0, 0.9, 0], [0, 0, 1], PLASTER),
    rectangle([-1.5, 2.2, -2.3], [1.8, 0, 0], [0, 0.5, 0], [0, 0, 1], PLASTER),
    ...box([-1.55, 0.86, -2.32], [1.9, 0.05, 0.16], LINEN),
    ...box([-1.55, 2.18, -2.32], [1.9, 0.05, 0.08], LINEN),
    ...box([-1.55, 0.9, -2.32], [0.05, 1.3, 0.08], LINEN),
    ...box([0.3, 0.9, -2.32], [0.05, 1.3, 0.08], LINEN),
    ...box([-0.62, 0.9, -2.32], [0.04, 1.3, 0.05], LINEN),
    // The front wall has an open doorway at its right end.
    rectangle([-3, 0, 2.3], [4.6, 0, 0], [0, 2.7, 0], [0, 0, -1], PLASTER),
    rectangle([2.5, 0, 2.3], [0.5, 0, 0], [0, 2.7, 0], [0, 0, -1], PLASTER),
    rectangle([1.6, 2.1, 2.3], [0.9, 0, 0], [0, 0.6, 0], [0, 0, -1], PLASTER),
    rectangle([-3, 0, -2.3], [0, 0, 4.6], [0, 2.7, 0], [1, 0, 0], PLASTER),
    rectangle([3, 0, -2.3], [0, 0, 4.6], [0, 2.7, 0], [-1, 0, 0], PLASTER),
  ];
}

function furniture(random: () => number): Surface[] {
  return [
    rectangle([-2.0, 0.012, -1.1], [2.6, 0, 0], [0, 0, 1.9], [0, 1, 0], RUG),
    ...sofa(),
    ...box([-1.3, 0.38, -0.55], [1.1, 0.04, 0.6], WALNUT),
    ...legs([-1.26, 0, -0.51], [1.02, 0.38, 0.52], 0.045, WALNUT),
    // Dining table with four chairs.
    ...box([0.95, 0.72, 0.1], [1.5, 0.04, 0.9], OAK),
    ...legs([1.0, 0, 0.15], [1.4, 0.72, 0.8], 0.06, OAK),
    ...chair(1.15, -0.28, -1),
    ...chair(1.85, -0.28, -1),
    ...chair(1.15, 0.95, 1),
    ...chair(1.85, 0.95, 1),
    sphere([1.55, 0.87, 0.5], 0.11, CLAY),
    ...bookcase(random),
    ...floorLamp(-2.6, -1.9),
    ...plant(2.55, 1.75, random),
    ...box([-2.99, 1.35, -0.5], [0.03, 0.6, 0.9], WALNUT),
    ...box([1.2, 1.3, -2.29], [0.7, 0.9, 0.03], WALNUT),
  ];
}

function sofa(): Surface[] {
  return [
    ...box([-2.95, 0.08, -0.95], [0.85, 0.34, 2.0], FABRIC),
    ...box([-2.95, 0.42, -0.95], [0.22, 0.42, 2.0], FABRIC),
    ...box([-2.95, 0.08, -1.13], [0.85, 0.54, 0.18], FABRIC),
    ...box([-2.95, 0.08, 1.05], [0.85, 0.54, 0.18], FABRIC),
    sphere([-2.6, 0.56, -0.68], 0.17, CUSHION),
    sphere([-2.6, 0.56, 0.78], 0.17, LINEN),
  ];
}

/** A chair at (x, z), its back on the side `back` (−1 or 1 along z). */
function chair(x: number, z: number, back: number): Surface[] {
  const behind = back < 0 ? z - 0.2 : z + 0.17;
  return [
    ...box([x - 0.2, 0.44, z - 0.2], [0.4, 0.03, 0.4], WALNUT),
    ...legs([x - 0.19, 0, z - 0.19], [0.38, 0.44, 0.38], 0.035, WALNUT),
    ...box([x - 0.2, 0.62, behind], [0.4, 0.3, 0.025], WALNUT),
    ...box([x - 0.19, 0.47, behind], [0.03, 0.45, 0.025], WALNUT),
    ...box([x + 0.16, 0.47, behind], [0.03, 0.45, 0.025], WALNUT),
  ];
}

function bookcase(random: () => number): Surface[] {
  const parts = [...box([2.68, 0, -2.1], [0.3, 2.0, 0.03], WALNUT), ...box([2.68, 0, -0.75], [0.3, 2.0, 0.03], WALNUT)];
  for (let shelf = 0; shelf < 6; shelf++) {
    const y = 0.05 + shelf * 0.38;
    parts.push(...box([2.68, y, -2.07], [0.3, 0.025, 1.32], WALNUT));
    if (shelf === 5) break;
    for (let z = -2.05; z < -0.95;) {
      const width = 0.025 + 0.035 * random();
      const height = 0.2 + 0.11 * random();
      const color = BOOKS[Math.floor(random() * BOOKS.length)]!;
      if (random() < 0.85) parts.push(...box([2.74, y + 0.025, z], [0.2, height, width], color));
      z += width + 0.004;
    }
  }
  return parts;
}

function floorLamp(x: number, z: number): Surface[] {
  return [
    cylinder([x, 0, z], 0.15, 0.15, 0.03, BRASS),
    cylinder([x, 0.03, z], 0.015, 0.015, 1.45, BRASS),
    cylinder([x, 1.4, z], 0.24, 0.15, 0.3, LINEN),
  ];
}

function plant(x: number, z: number, random: () => number): Surface[] {
  const parts = [cylinder([x, 0, z], 0.14, 0.19, 0.36, CLAY), cylinder([x, 0.36, z], 0.02, 0.015, 0.7, WALNUT)];
  for (let leaf = 0; leaf < 26; leaf++) {
    const turn = 2 * Math.PI * random();
    const reach = 0.34 * Math.sqrt(random());
    const center: Vector = [x + reach * Math.cos(turn), 0.85 + 0.75 * random(), z + reach * Math.sin(turn)];
    parts.push(sphere(center, 0.05 + 0.06 * random(), LEAF));
  }
  return parts;
}

function rectangle(corner: Vector, a: Vector, b: Vector, normal: Vector, color: Color): Surface {
  const area = Math.hypot(...a) * Math.hypot(...b);
  return {
    area,
    color,
    pieces: [1, 1],
    at: (u, v) => ({ point: corner.map((value, axis) => value + u * a[axis]! + v * b[axis]!) as Vector, normal }),
  };
}

function box([x, y, z]: Vector, [w, h, d]: Vector, color: Color): Surface[] {
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
function legs([x, y, z]: Vector, [w, h, d]: Vector, thick: number, color: Color): Surface[] {
  const size: Vector = [thick, h, thick];
  return [
    ...box([x, y, z], size, color),
    ...box([x + w - thick, y, z], size, color),
    ...box([x, y, z + d - thick], size, color),
    ...box([x + w - thick, y, z + d - thick], size, color),
  ];
}

/** An upright cylinder or a truncated cone, open at both ends. */
function cylinder([x, y, z]: Vector, bottom: number, top: number, height: number, color: Color): Surface {
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

function sphere([x, y, z]: Vector, r: number, color: Color): Surface {
  return {
    area: 4 * Math.PI * r * r,
    color,
    pieces: [64, 32],
    at(u, v) {
      // Archimedes: even in height and in longitude is even on the sphere.
      const turn = 2 * Math.PI * u;
      const up = 2 * v - 1;
      const ring = Math.sqrt(1 - up * up);
      const normal: Vector = [ring * Math.cos(turn), up, ring * Math.sin(turn)];
      return { point: [x + r * normal[0], y + r * up, z + r * normal[2]], normal };
    },
  };
}

function dot(a: Vector, b: Vector): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** A small well-known generator (Tommy Ettinger's mulberry32): 32 bits of state, the same numbers everywhere. */
export function mulberry32(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}
