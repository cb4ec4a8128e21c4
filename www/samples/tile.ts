import type { LoadedCloud } from "../cloud/cloud.ts";
import { grid, joined, type Mesh, mulberry32, type Truth } from "./generator.ts";
import type { Vector } from "./trace.ts";

/** The place where a beam comes back: meters in the tile, the class as in LAS files, the brightness. */
interface Return {
  x: number;
  y: number;
  z: number;
  kind: number;
  tone: number;
  /** The house that it met, and whether it met a wall of it. */
  house?: House;
  wall?: boolean;
  /** The lower end of the crown that it met, at this place. */
  bottom?: number;
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
function makeLand(side: number, random: () => number) {
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
    houses,
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
        return wall ? { ...hit, z: z + DOWN * random(), wall } : hit;
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

/** A place in the directions of a house: along its ridge, and across it. */
function inHouse({ x: cx, y: cy, turn }: House, x: number, y: number): [along: number, across: number] {
  const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
  return [(x - cx) * cos + (y - cy) * sin, (y - cy) * cos - (x - cx) * sin];
}

function roofHeight({ base, ridge, eaves, halfWidth }: House, across: number): number {
  return base + ridge - ((ridge - eaves) * Math.abs(across)) / halfWidth;
}

/** Half the width of a chimney, and its middle. */
const CHIMNEY = 0.45;
const chimneyOf = ({ halfLength }: House) => [0.5 * halfLength, 0.8] as const;

function roofAt(house: House, x: number, y: number): Return | null {
  const { turn, halfLength, halfWidth, ridge, base, tone } = house;
  const [along, across] = inHouse(house, x, y);
  if (Math.abs(along) > halfLength || Math.abs(across) > halfWidth) return null;
  const [a, b] = chimneyOf(house);
  const chimney = Math.abs(along - a) < CHIMNEY && Math.abs(across - b) < CHIMNEY;
  const z = chimney ? base + ridge + 1 : roofHeight(house, across);
  // One side of the roof lies in the sun.
  return { x, y, z, kind: 6, tone: tone * (across * Math.cos(turn) < 0 ? 1.12 : 0.9), house };
}

function crownAt({ x: cx, y: cy, radius, top, base }: Tree, x: number, y: number, random: () => number): Return | null {
  const off = Math.hypot(x - cx, y - cy) / radius;
  if (off > 1 || random() < 0.12 + 0.3 * off) return null;
  const depth = (top - base) * 0.75;
  const z = top - depth * (0.5 - 0.5 * Math.sqrt(1 - off * off)) - 0.5 * random() * random() * depth;
  const bottom = top - depth * (0.5 + 0.5 * Math.sqrt(1 - off * off));
  return { x, y, z, kind: 5, tone: 0.75 + (0.5 * (z - base)) / (top - base), bottom };
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

const SEED = 32632;
const ORIGIN: Vector = [512_000, 5_403_000, 420];
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

/** Every return with its number, and the chance in its height, its color and its brightness. */
function* fly(land: ReturnType<typeof makeLand>, random: () => number) {
  const chance = (at: Return, nth: number) => ({
    at,
    nth,
    scatter: NOISE * 1.7 * (random() + random() + random() + random() - 2),
    light: random(),
    shine: random(),
  });
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
        yield chance(first, 1);
        if (first.kind !== 5 || random() > 0.4) continue;
        const second = land.below(first, across);
        if (second) yield chance(second, 2);
      }
    }
  }
}

/** The same land and the same flight each time. */
function flown() {
  const random = mulberry32(SEED);
  const land = makeLand(SIDE, random);
  return { houses: land.houses, returns: fly(land, random) };
}

export function make(): LoadedCloud {
  const positions: number[] = [];
  const colors: number[] = [];
  const intensity: number[] = [];
  const classification: number[] = [];
  const returnNumber: number[] = [];
  for (const { at, nth, scatter, light, shine } of flown().returns) {
    const { x, y, z, kind, tone } = at;
    const place = ORIGIN.map((from, axis) => from + [x, y, z + scatter][axis]!);
    positions.push(...place.map((value) => Math.round(value * 1000) / 1000));
    const { color, gloss } = LOOKS[kind]!;
    colors.push(...color.map((value) => Math.min(255, Math.round(value * tone * (0.93 + 0.14 * light)))));
    intensity.push(Math.min(255, Math.round(255 * gloss * (nth === 1 ? 1 : 0.45) * (0.8 + 0.4 * shine))));
    classification.push(kind);
    returnNumber.push(nth);
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

/** How far a place stands before its surface, in meters, so that the surface does not hide it. */
const BEFORE = 0.01;
/** The place is no corner and no part of a face. */
const NO_FACE = 0xffffffff;

/**
 * The ground in pieces of a meter, the houses, and leaves: triangles as wide as beams are apart, turned by chance. Each beam
 * that came back from a tree met one. Below it the crown goes on, with a leaf at each step.
 */
export function truth(): Truth {
  const { houses, returns } = flown();
  const ground = grid(SIDE, SIDE, (u, v) => [SIDE * u, SIDE * v, groundAt(SIDE * u, SIDE * v).z]);
  const built = joined([ground, ...houses.flatMap(housePieces)]);
  const firstLeaf = built.triangles.length / 3;
  const leaves: number[] = [];
  const places: number[] = [];
  const faces: number[] = [];
  const random = mulberry32(SEED);
  for (const { at } of returns) {
    const { x, y, z, bottom } = at;
    faces.push(bottom === undefined ? NO_FACE : firstLeaf + leaves.length / 9);
    places.push(...(bottom === undefined ? placeOf(at) : [x, y, z]));
    for (let height = z; height >= (bottom ?? Infinity); height -= STEP) leaves.push(...leafAt([x, y, height], random));
  }
  const corners = Uint32Array.from({ length: leaves.length / 3 }, (_, i) => i);
  const leafMesh = { positions: Float32Array.from(leaves), triangles: corners };
  return {
    mesh: joined([built, leafMesh]),
    on: { positions: Float32Array.from(places), faces: Uint32Array.from(faces) },
    origin: ORIGIN,
  };
}

/** The corners of a triangle around a place. */
function leafAt(place: Vector, random: () => number): number[] {
  const up = 2 * random() - 1;
  const turn = 2 * Math.PI * random();
  const level = Math.sqrt(1 - up * up);
  const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
  // Two directions at right angles in its plane.
  const right = [-sin, cos, 0];
  const ahead = [-up * cos, -up * sin, level];
  return [0, 1, 2].flatMap((corner) => {
    const angle = (2 * Math.PI * corner) / 3;
    const reach = STEP / Math.sqrt(3);
    return place.map(
      (value, axis) => value + reach * (Math.cos(angle) * right[axis]! + Math.sin(angle) * ahead[axis]!),
    );
  });
}

/** Two sides of the roof, four walls and the chimney. */
function housePieces(house: House): Mesh[] {
  const { x, y, turn, halfLength: long, halfWidth: wide, base, eaves, ridge } = house;
  const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
  const piece = (at: (u: number, v: number) => Vector) =>
    grid(1, 1, (u, v) => {
      const [a, b, z] = at(u, v);
      return [x + a * cos - b * sin, y + a * sin + b * cos, z];
    });
  // Walls begin below the ground, which is not level.
  const [foot, top] = [base - 3, base + ridge + 1];
  const [a, b] = chimneyOf(house);
  return [
    ...[-1, 1].flatMap((side) => [
      piece((u, v) => [long * (2 * u - 1), side * wide * v, roofHeight(house, wide * v)]),
      piece((u, v) => [long * (2 * u - 1), side * wide, foot + v * (base + eaves - foot)]),
      ...[-1, 1].map((end) =>
        piece((u, v) => [end * long, side * wide * u, foot + v * (roofHeight(house, wide * u) - foot)]),
      ),
      piece((u, v) => [a + CHIMNEY * (2 * u - 1), b + side * CHIMNEY, base + eaves + v * (top - base - eaves)]),
      piece((u, v) => [a + side * CHIMNEY, b + CHIMNEY * (2 * u - 1), base + eaves + v * (top - base - eaves)]),
    ]),
    piece((u, v) => [a + CHIMNEY * (2 * u - 1), b + CHIMNEY * (2 * v - 1), top]),
  ];
}

/** The place just before the pieces of the ground or of a house for a point that came back from it. */
function placeOf({ x, y, z, house, wall }: Return): Vector {
  if (!house) return [x, y, groundPiece(x, y) + BEFORE];
  if (!wall) return [x, y, z + BEFORE];
  // The nearest wall, or the nearest side of the chimney.
  const [along, across] = inHouse(house, x, y);
  const [a, b] = chimneyOf(house);
  const isChimney = z > roofHeight(house, across);
  const [middle, half] = isChimney ? [[a, b], [CHIMNEY, CHIMNEY]] : [[0, 0], [house.halfLength, house.halfWidth]]; // prettier-ignore
  const off = [along - middle[0]!, across - middle[1]!];
  const axis = half[0]! - Math.abs(off[0]!) < half[1]! - Math.abs(off[1]!) ? 0 : 1;
  off[axis] = Math.sign(off[axis]!) * (half[axis]! + BEFORE);
  const [from, aside] = [middle[0]! + off[0]!, middle[1]! + off[1]!];
  const [cos, sin] = [Math.cos(house.turn), Math.sin(house.turn)];
  return [house.x + from * cos - aside * sin, house.y + from * sin + aside * cos, z];
}

/** The height of the flat pieces of the ground. */
function groundPiece(x: number, y: number): number {
  const [column, row] = [x, y].map((value) => Math.max(0, Math.min(SIDE - 1, Math.floor(value)))) as [number, number];
  const [right, up] = [x - column, y - row];
  const corner = (across: number, above: number) => groundAt(column + across, row + above).z;
  const isLower = right + up <= 1;
  const [from, a, b] = isLower
    ? [corner(0, 0), corner(1, 0), corner(0, 1)]
    : [corner(1, 1), corner(0, 1), corner(1, 0)];
  return from + (isLower ? right : 1 - right) * (a - from) + (isLower ? up : 1 - up) * (b - from);
}
