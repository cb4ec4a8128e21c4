import type { LoadedCloud } from "../cloud/cloud.ts";
import { mulberry32 } from "./generator.ts";

/** The place where a beam comes back: meters in the tile, the class as in LAS files, the brightness. */
export interface Return {
  x: number;
  y: number;
  z: number;
  kind: number;
  tone: number;
}

interface House {
  x: number;
  y: number;
  /** The angle between the ridge of its roof and east. */
  turn: number;
  halfLength: number;
  halfWidth: number;
  eaves: number;
  ridge: number;
  base: number;
  tone: number;
}

interface Tree {
  x: number;
  y: number;
  radius: number;
  top: number;
  base: number;
}

const CELL = 10;
/** The length of a beam's steps on its way down, in meters. */
const DOWN = 0.6;

/** Hills, a stream, a road with houses along it, and trees, for beams from above. */
export function makeLand(side: number, random: () => number) {
  const houses: House[] = [];
  const trees: Tree[] = [];
  const isFree = (x: number, y: number, gap: number) =>
    houses.every((house) => Math.hypot(house.x - x, house.y - y) > gap);

  for (let x = 14; x < side - 10; x += 17 + 6 * random()) {
    for (const across of [-1, 1]) {
      if (random() < 0.12) continue;
      const y = roadAt(x) + across * (17 + 5 * random());
      const slope = (roadAt(x + 1) - roadAt(x - 1)) / 2;
      houses.push(house(x, y, Math.atan(slope) + (random() < 0.3 ? Math.PI / 2 : 0), random));
    }
  }
  for (let i = 0; i < 9; i++) {
    const [x, y] = [30 + 110 * random(), 215 + 70 * random()];
    if (isFree(x, y, 22)) houses.push(house(x, y, Math.PI * random(), random));
  }
  for (let i = 0; i < 520; i++) {
    // There is a wood on the hill, a row of trees along the stream, and some trees between the houses.
    const place =
      i < 330
        ? [190 + 130 * random(), 195 + 125 * random()]
        : i < 400
          ? [side * random(), 0]
          : [side * random(), side * random()];
    const x = place[0]!;
    const y = i >= 330 && i < 400 ? streamAt(x) + (random() < 0.5 ? -1 : 1) * (5 + 3 * random()) : place[1]!;
    const radius = 1.6 + 2.2 * random();
    if (!isFree(x, y, 10 + radius) || Math.abs(y - roadAt(x)) < 5 + radius) continue;
    const base = terrain(x, y);
    trees.push({ x, y, radius, base, top: base + 5 + 2.6 * radius + 3 * random() });
  }

  const near = cells(side, [...houses, ...trees]);
  /** The highest surface at a place. */
  const surface = (x: number, y: number): Return => {
    let found = groundAt(x, y);
    for (const thing of near(x, y)) {
      const hit = "ridge" in thing ? roofAt(thing, x, y) : crownAt(thing, x, y, random);
      if (hit && hit.z > found.z) found = hit;
    }
    return found;
  };

  return {
    /** The first return of a beam to (x, y) that goes `across` meters to the west for each meter down. */
    first(x: number, y: number, across: number): Return | null {
      const things = near(x, y);
      if (things.length === 0) return groundAt(x, y);
      const ground = terrain(x, y);
      // The beam starts above everything there, and goes down until it meets something.
      const highest = things.reduce(
        (most, thing) => Math.max(most, "ridge" in thing ? thing.base + thing.ridge + 1 : thing.top),
        ground,
      );
      for (let z = highest + DOWN; z > ground - 2; z -= DOWN) {
        const east = x - across * (z - ground);
        if (east < 0 || east > side) return null;
        const hit = surface(east, y);
        if (hit.z < z) continue;
        // A beam meets a wall from the side, between the last step and this one. It meets a roof or the ground from
        // above.
        const wall = hit.kind === 6 && hit.z - z > 1.2;
        return wall ? { ...hit, z: z + DOWN * random() } : hit;
      }
      return groundAt(x, y);
    },
    below({ x, y }: Return, across: number): Return | null {
      const ground = groundAt(x + across * 6, y);
      return near(x, y).some((thing) => "ridge" in thing && roofAt(thing, x, y)) ? null : ground;
    },
  };
}

function terrain(x: number, y: number): number {
  const hill = 34 * Math.exp(-(((x - 285) / 120) ** 2) - ((y - 290) / 110) ** 2);
  const waves = 2.2 * Math.sin(x / 41 + 0.6) * Math.cos(y / 53) + 0.9 * Math.sin(x / 13 + y / 17);
  const bank = Math.min(1, Math.abs(y - streamAt(x)) / 7);
  return 8 + hill + waves * bank - 2.4 * (1 - bank * bank);
}

function streamAt(x: number): number {
  return 44 + 16 * Math.sin(x / 58) + 5 * Math.sin(x / 21);
}

function roadAt(x: number): number {
  return 142 + 22 * Math.sin(x / 84 + 0.9);
}

function groundAt(x: number, y: number): Return {
  const z = terrain(x, y);
  const off = Math.abs(y - roadAt(x));
  if (Math.abs(y - streamAt(x)) < 2.6) return { x, y, z, kind: 9, tone: 1 };
  if (off < 3) return { x, y, z, kind: 11, tone: off < 0.12 ? 1.45 : 1 };
  const meadow = Math.sin(x / 9) * Math.sin(y / 7) > 0.55;
  return { x, y, z: meadow ? z + 0.25 : z, kind: meadow ? 3 : 2, tone: 0.94 + 0.1 * Math.sin(x / 23 + y / 31) };
}

function house(x: number, y: number, turn: number, random: () => number): House {
  const halfWidth = 3.6 + 1.6 * random();
  const eaves = 3.2 + 3.2 * Math.floor(2 * random());
  return {
    x,
    y,
    turn,
    halfLength: halfWidth + 1 + 3.5 * random(),
    halfWidth,
    eaves,
    ridge: eaves + halfWidth * (0.6 + 0.3 * random()),
    base: terrain(x, y),
    tone: 0.8 + 0.4 * random(),
  };
}

function roofAt(
  { x: cx, y: cy, turn, halfLength, halfWidth, eaves, ridge, base, tone }: House,
  x: number,
  y: number,
): Return | null {
  const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
  const along = (x - cx) * cos + (y - cy) * sin;
  const across = (y - cy) * cos - (x - cx) * sin;
  if (Math.abs(along) > halfLength || Math.abs(across) > halfWidth) return null;
  const z = base + ridge - ((ridge - eaves) * Math.abs(across)) / halfWidth;
  const chimney = Math.abs(along - 0.5 * halfLength) < 0.45 && Math.abs(across - 0.8) < 0.45;
  // One side of the roof lies in the sun.
  return { x, y, z: chimney ? base + ridge + 1 : z, kind: 6, tone: tone * (across * cos < 0 ? 1.12 : 0.9) };
}

function crownAt({ x: cx, y: cy, radius, top, base }: Tree, x: number, y: number, random: () => number): Return | null {
  const off = Math.hypot(x - cx, y - cy) / radius;
  if (off > 1 || random() < 0.12 + 0.3 * off) return null;
  const depth = (top - base) * 0.75;
  const z = top - depth * (0.5 - 0.5 * Math.sqrt(1 - off * off)) - 0.5 * random() * random() * depth;
  return { x, y, z, kind: 5, tone: 0.75 + (0.5 * (z - base)) / (top - base) };
}

/** Finds the things near a place, with the cells of a grid. */
function cells<T extends { x: number; y: number }>(
  side: number,
  things: readonly T[],
): (x: number, y: number) => readonly T[] {
  const width = Math.ceil(side / CELL) + 1;
  const lists = new Map<number, T[]>();
  const key = (x: number, y: number) => Math.floor(x / CELL) * width + Math.floor(y / CELL);
  for (const thing of things) {
    for (const dx of [-CELL, 0, CELL]) {
      for (const dy of [-CELL, 0, CELL]) {
        const at = key(thing.x + dx, thing.y + dy);
        lists.set(at, [...(lists.get(at) ?? []), thing]);
      }
    }
  }
  return (x, y) => lists.get(key(x, y)) ?? [];
}

/*
 * A tile of 320 × 320 meters as an airplane's laser scanner maps it, in UTM coordinates (zone 32 north, meters, z up). They
 * are far from the origin and in whole millimeters, so they need 64 bits. Flight lines run north and the beam swings across
 * them, so walls are seen on one side only. A part of a beam into a tree comes back from the ground. The points are the same
 * on every machine.
 */

const EAST = 512_000;
const NORTH = 5_403_000;
const SIDE = 320;
/** The distance between two sweeps along the line of flight, and between two beams of a sweep. */
const STEP = 0.66;
const FLIGHT_HEIGHT = 700;
const LINES = [70, 250];
/** One standard deviation, in meters. */
const NOISE = 0.02;

const LABELS = { 2: "ground", 3: "low vegetation", 5: "high vegetation", 6: "building", 9: "water", 11: "road" };
/** The color of a surface from above, and the share of the light that it sends back. */
const LOOKS: Record<number, { color: readonly [number, number, number]; gloss: number }> = {
  2: { color: [132, 146, 92], gloss: 0.5 },
  3: { color: [116, 136, 74], gloss: 0.55 },
  5: { color: [72, 102, 58], gloss: 0.4 },
  6: { color: [168, 98, 74], gloss: 0.65 },
  9: { color: [72, 96, 112], gloss: 0.06 },
  11: { color: [140, 140, 142], gloss: 0.25 },
};

export function make(): LoadedCloud {
  const random = mulberry32(32632);
  const land = makeLand(SIDE, random);
  const positions: number[] = [];
  const colors: number[] = [];
  const intensity: number[] = [];
  const classification: number[] = [];
  const returnNumber: number[] = [];

  const put = ({ x, y, z, kind, tone }: Return, nth: number) => {
    const scatter = NOISE * 1.7 * (random() + random() + random() + random() - 2);
    [EAST + x, NORTH + y, 420 + z + scatter].forEach((value) => positions.push(Math.round(value * 1000) / 1000));
    const { color, gloss } = LOOKS[kind]!;
    const light = tone * (0.93 + 0.14 * random());
    colors.push(...color.map((value) => Math.min(255, Math.round(value * light))));
    intensity.push(Math.min(255, Math.round(255 * gloss * (nth === 1 ? 1 : 0.45) * (0.8 + 0.4 * random()))));
    classification.push(kind);
    returnNumber.push(nth);
  };

  for (const line of LINES) {
    for (let y = 0; y < SIDE; y += STEP) {
      // Two neighboring strips meet halfway between their flight lines.
      const [from, to] = line < SIDE / 2 ? [0, SIDE / 2] : [SIDE / 2, SIDE];
      for (let x = from + STEP * random(); x < to; x += STEP) {
        const northing = y + STEP * 0.3 * random();
        const across = (x - line) / FLIGHT_HEIGHT;
        const first = land.first(x, northing, across);
        // Water is a mirror: it sends hardly anything back to the airplane.
        if (!first || (first.kind === 9 && random() < 0.85)) continue;
        put(first, 1);
        if (first.kind !== 5 || random() > 0.4) continue;
        const second = land.below(first, across);
        if (second) put(second, 2);
      }
    }
  }
  return {
    positions: Float64Array.from(positions),
    colors: Uint8Array.from(colors),
    attributes: [
      { name: "intensity", kind: "scalar", values: Uint8Array.from(intensity) },
      { name: "classification", kind: "category", values: Uint8Array.from(classification), labels: LABELS },
      { name: "return number", kind: "category", values: Uint8Array.from(returnNumber) },
    ],
    facts: {
      decimals: [3, 3, 3],
      crs: { name: "UTM zone 32N", unit: { name: "m", meters: 1 }, heightUnit: null, isAngular: false },
    },
  };
}
