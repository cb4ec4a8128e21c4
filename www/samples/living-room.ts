import type { LoadedCloud } from "../cloud/cloud.ts";
import { grid, joined, mulberry32, type Truth } from "./generator.ts";

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

/*
 * A living room of 6 × 2.7 × 4.6 meters, as a scanner might measure it. Points are spread evenly over every surface,
 * with two millimeters of noise. The colors are muted and contain soft light. y is up, the floor is y = 0, the middle
 * is x = z = 0. The seed is fixed: the points are the same on every machine.
 */

/** Of so many places, those stay that nothing touches. */
const TRIED = 343_531;
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

export function make(): LoadedCloud {
  const positions = new Float32Array(3 * TRIED);
  const colors = new Uint8Array(3 * TRIED);
  let end = 0;
  for (const { surface, u, v, off, grain } of scanRoom().places) {
    const { point, normal } = surface.at(u, v);
    const light = 0.72 + 0.28 * Math.max(0, dot(normal, LIGHT)) + 0.05 * (grain - 0.5);
    for (let axis = 0; axis < 3; axis++, end++) {
      positions[end] = point[axis]! + off * normal[axis]!;
      colors[end] = Math.min(255, surface.color[axis]! * light);
    }
  }
  return {
    positions: positions.slice(0, end),
    colors: colors.slice(0, end),
    facts: { crs: { name: "Its own", unit: { name: "m", meters: 1 }, heightUnit: null, isAngular: false } },
  };
}

/** A point's place on its surface, its distance from the surface, and a random number from 0 to 1 for its color. */
interface Place {
  surface: Surface;
  u: number;
  v: number;
  off: number;
  grain: number;
}

/** All surfaces of the room, and the places of its points on them, surface after surface. */
function scanRoom(): { surfaces: Surface[]; places: Iterable<Place> } {
  const random = mulberry32(20070802);
  const surfaces = roomSurfaces(random);
  return { surfaces, places: scatter(surfaces, random) };
}

/**
 * The surfaces as flat pieces, and for each point of the cloud its place on one of the pieces. This place has no noise.
 */
export function truth(): Truth {
  const { surfaces, places } = scanRoom();
  const mesh = joined(surfaces.map((surface) => grid(...surface.pieces, (u, v) => surface.at(u, v).point)));
  const firstFace = new Map<Surface, number>();
  let faces = 0;
  for (const surface of surfaces) {
    firstFace.set(surface, faces);
    faces += 2 * surface.pieces[0] * surface.pieces[1];
  }
  const on = { positions: [] as number[], faces: [] as number[] };
  for (const { surface, u, v } of places) {
    const { place, face } = onPieces(surface, u, v);
    on.positions.push(...place);
    on.faces.push(firstFace.get(surface)! + face);
  }
  return { mesh, on: { positions: Float32Array.from(on.positions), faces: Uint32Array.from(on.faces) } };
}

/** The point of the flat pieces that replaces the surface's point at u, v, and the number of its triangle in `grid`. */
function onPieces(surface: Surface, u: number, v: number): { place: Vector; face: number } {
  const [columns, rows] = surface.pieces;
  const [column, row] = [Math.floor(u * columns), Math.floor(v * rows)];
  const [across, up] = [u * columns - column, v * rows - row];
  const corner = (right: number, above: number) => surface.at((column + right) / columns, (row + above) / rows).point;
  const lower = across + up <= 1;
  const [from, a, b] = lower ? [corner(0, 0), corner(1, 0), corner(0, 1)] : [corner(1, 1), corner(0, 1), corner(1, 0)];
  const [alongA, alongB] = lower ? [across, up] : [1 - across, 1 - up];
  const place = from.map((value, axis) => value + alongA * (a[axis]! - value) + alongB * (b[axis]! - value)) as Vector;
  return { place, face: 2 * (row * columns + column) + (lower ? 0 : 1) };
}

/** No scanner measures a place that has another surface this near before it: under a rug, behind a picture. */
const TOUCHING = 0.022;

/** The box around a flat piece, which is parallel to two axes. */
type Box = readonly (readonly [low: number, high: number])[];

function boxOf(surface: Surface): Box {
  const corners = [0, 1].flatMap((v) => [surface.at(0, v).point, surface.at(1, v).point]);
  return [0, 1, 2].map((axis) => {
    const values = corners.map((corner) => corner[axis]!);
    return [Math.min(...values), Math.max(...values)] as const;
  });
}

/**
 * A test for the points of a flat surface: whether another flat surface touches it there. `boxes` are those of all flat
 * surfaces.
 */
function touchTest(surface: Surface, boxes: ReadonlyMap<Surface, Box>): (point: Vector) => boolean {
  const { normal } = surface.at(0.5, 0.5);
  const reach = normal.map((value) => TOUCHING * value);
  const meets = (box: Box, low: (axis: number) => number, high: (axis: number) => number) => {
    for (let axis = 0; axis < 3; axis++) {
      const [from, to] = box[axis]!;
      if (from > high(axis) + Math.max(0, reach[axis]!) || to < low(axis) + Math.min(0, reach[axis]!)) return false;
    }
    return true;
  };
  const own = boxes.get(surface)!;
  const across = normal.findIndex((value) => value !== 0);
  const near = [...boxes.values()].filter((box) => {
    const isParallel = box[across]![0] === box[across]![1];
    const [low, high] = [(axis: number) => own[axis]![0], (axis: number) => own[axis]![1]];
    return box !== own && isParallel && meets(box, low, high);
  });
  return (point) => {
    const at = (axis: number) => point[axis]!;
    return near.some((box) => meets(box, at, at));
  };
}

function isFlat({ pieces }: Surface): boolean {
  return pieces[0] === 1 && pieces[1] === 1;
}

function* scatter(surfaces: readonly Surface[], random: () => number): Generator<Place> {
  const total = surfaces.reduce((sum, surface) => sum + surface.area, 0);
  const boxes = new Map(surfaces.filter(isFlat).map((surface) => [surface, boxOf(surface)]));
  let area = 0;
  let i = 0;
  for (const surface of surfaces) {
    area += surface.area;
    const end = Math.round((area / total) * TRIED);
    const isTouched = isFlat(surface) ? touchTest(surface, boxes) : () => false;
    // Rows without any jitter would make moiré patterns on a screen.
    const jitter = 0.6 / Math.sqrt(Math.max(1, end - i));
    let u = random();
    let v = random();
    for (; i < end; i++) {
      const here = { u: (u + jitter * random()) % 1, v: (v + jitter * random()) % 1 };
      // M. Roberts' R2 sequence fills a square evenly, as a scanner does. Independent random points leave holes.
      u = (u + 0.7548776662466927) % 1;
      v = (v + 0.5698402909980532) % 1;
      const place = { surface, ...here, off: NOISE * (random() + random() + random() - 1.5), grain: random() };
      if (!isTouched(surface.at(here.u, here.v).point)) yield place;
    }
  }
}

/** Everything in the room. `random` chooses the books and the leaves. */
export function roomSurfaces(random: () => number): Surface[] {
  return [...shell(), ...furniture(random)];
}

function shell(): Surface[] {
  return [
    rectangle([-3, 0, -2.3], [6, 0, 0], [0, 0, 4.6], [0, 1, 0], OAK),
    rectangle([-3, 2.7, -2.3], [6, 0, 0], [0, 0, 4.6], [0, -1, 0], CEILING),
    // The back wall has a window of 1.8 × 1.3 m: a hole with a frame.
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
