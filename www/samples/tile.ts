import type { LoadedCloud } from "../cloud/cloud.ts";
import { gaussian, mulberry32, type Truth } from "./generator.ts";
import { box, cylinder, group, type Hit, type Material, nested, type Solid, sphere, type Vector } from "./trace.ts";

/*
 * A tile of 320 × 320 meters as an airplane's laser scanner maps it, in UTM coordinates (zone 32 north, meters, z up). They
 * are far from the origin and in whole millimeters, so they need 64 bits. Flight lines run north and the beam swings across
 * them. A part of a beam into a tree comes back from the ground. The points are the same on every machine.
 */

const SEED = 32632;
const ORIGIN: Vector = [512_000, 5_403_000, 424];
const SIDE = 320;
/** The distance between two sweeps along the line of flight, and between two beams of a sweep. */
const STEP = 0.66;
const FLIGHT_HEIGHT = 700;
const LINES = [70, 250];
/** One standard deviation, in meters. */
const NOISE = 0.03;

const LABELS = { 2: "ground", 3: "low vegetation", 5: "high vegetation", 6: "building", 9: "water", 11: "road" };
const GRASS: Material = { color: [132, 146, 92], kind: 2, gloss: 0.5 };
const MEADOW: Material = { color: [116, 136, 74], kind: 3, gloss: 0.55 };
const LEAVES: Material = { color: [72, 102, 58], kind: 5, gloss: 0.4 };
const BARK: Material = { color: [104, 84, 66], kind: 5, gloss: 0.35 };
const ROOF: Material = { color: [168, 98, 74], kind: 6, gloss: 0.65 };
const WALL: Material = { color: [206, 196, 178], kind: 6, gloss: 0.6 };
const WATER: Material = { color: [72, 96, 112], kind: 9, gloss: 0.06 };
const ROAD: Material = { color: [140, 140, 142], kind: 11, gloss: 0.25 };
const LINE: Material = { color: [206, 206, 204], kind: 11, gloss: 0.8 };

/** Hills are the tops of balls. */
const HILLS: [center: Vector, radius: number][] = [
  [[270, 285, -270], 302],
  [[60, 320, -590], 604],
  [[250, 10, -885], 892],
];

const streamAt = (x: number) => 44 + 16 * Math.sin(x / 58) + 5 * Math.sin(x / 21);
const roadAt = (x: number) => 142 + 22 * Math.sin(x / 84 + 0.9);

function heightAt(x: number, y: number): number {
  const heights = HILLS.map(([[cx, cy, cz], radius]) => cz + Math.sqrt(radius ** 2 - (x - cx) ** 2 - (y - cy) ** 2));
  return Math.max(0, ...heights.filter(Number.isFinite));
}

function groundAt(x: number, y: number): Material {
  const off = Math.abs(y - roadAt(x));
  if (Math.abs(y - streamAt(x)) < 2.6) return WATER;
  if (off < 3) return off < 0.3 ? LINE : ROAD;
  return Math.sin(x / 9) * Math.sin(y / 7) > 0.55 ? MEADOW : GRASS;
}

function ground(): Solid<Material> {
  const hills = HILLS.map(([center, radius]) => sphere(center, radius, GRASS));
  const land = group([box([-SIDE, -SIDE, -5], [2 * SIDE, 2 * SIDE, 0], GRASS), ...hills]);
  return (from, along, reach) => {
    const hit = land(from, along, reach);
    return hit && { ...hit, material: groundAt(from[0] + hit.distance * along[0], from[1] + hit.distance * along[1]) };
  };
}

function house([x, y, z]: Vector, random: () => number) {
  const [long, wide, high] = [5 + 3 * random(), 4 + 1.5 * random(), 2.6 + 1.6 * Math.floor(2 * random())];
  const [a, b] = random() < 0.5 ? [long, wide] : [wide, long];
  const parts = [
    box([x - a, y - b, z - 3], [x + a, y + b, z + high], WALL),
    box([x - a, y - b, z + high], [x + a, y + b, z + high + 0.3], ROOF),
    box([x - 0.6 * a, y - 0.6 * b, z + high], [x + 0.6 * a, y + 0.6 * b, z + high + 1.6], ROOF),
  ];
  return { solid: group(parts), center: [x, y, z] as Vector, radius: 15 };
}

/** A trunk, and the balls of its leaves. */
function tree([x, y, z]: Vector, random: () => number) {
  const radius = 1.6 + 1.8 * random();
  const top = z + 4 + 1.4 * radius;
  const balls = Array.from({ length: 4 }, (_, i) => {
    const turn = (i * Math.PI) / 2 + random();
    const at: Vector = [x + 0.6 * radius * Math.cos(turn), y + 0.6 * radius * Math.sin(turn), top - radius * random()];
    return sphere(at, radius * (0.7 + 0.2 * random()), LEAVES);
  });
  const center: Vector = [x, y, top - radius / 2];
  return {
    trunk: { solid: cylinder([x, y, z - 1], 0.25, top - z, BARK), center, radius: top - z + 1 },
    crown: { solid: group(balls), center, radius: 2.2 * radius },
  };
}

/** A road with houses along it, a stream, a wood on the hill, and trees. `bare` has no leaves. */
function makeLand(random: () => number): { bare: Solid<Material>; whole: Solid<Material> } {
  const houses: Vector[] = [];
  const on = (x: number, y: number): Vector => [x, y, heightAt(x, y)];
  const isFree = (x: number, y: number, gap: number) => houses.every(([a, b]) => Math.hypot(a - x, b - y) > gap);
  for (let x = 14; x < SIDE - 10; x += 21 + 5 * random()) {
    for (const side of [-1, 1]) if (random() > 0.12) houses.push(on(x, roadAt(x) + side * (18 + 5 * random())));
  }
  for (let i = 0; i < 9; i++) {
    const [x, y] = [30 + 110 * random(), 215 + 70 * random()];
    if (isFree(x, y, 24)) houses.push(on(x, y));
  }
  const trees: Vector[] = [];
  for (let i = 0; i < 520; i++) {
    const [x, y] = i < 330 ? [190 + 130 * random(), 195 + 125 * random()] : [SIDE * random(), SIDE * random()];
    const isAlong = i >= 330 && i < 400;
    const place = on(x, isAlong ? streamAt(x) + (random() < 0.5 ? -1 : 1) * (6 + 3 * random()) : y);
    if (isFree(place[0], place[1], 15) && Math.abs(place[1] - roadAt(x)) > 8) trees.push(place);
  }
  const grown = trees.map((place) => tree(place, random));
  const things = [...houses.map((place) => house(place, random)), ...grown.map(({ trunk }) => trunk)];
  const bare = group([ground(), nested(things)]);
  return { bare, whole: group([bare, nested(grown.map(({ crown }) => crown))]) };
}

/** A return with its number, and the chance in its distance, its color and its brightness. */
interface Return {
  from: Vector;
  along: Vector;
  hit: Hit<Material>;
  nth: number;
  noise: number;
  light: number;
  shine: number;
}

function* fly(): Generator<Return> {
  const random = mulberry32(SEED);
  const { bare, whole } = makeLand(random);
  const chance = () => ({ noise: NOISE * gaussian(random), light: random(), shine: random() });
  for (const line of LINES) {
    for (let y = 0; y < SIDE; y += STEP) {
      // Two neighboring strips meet halfway between their flight lines.
      const [west, east] = line < SIDE / 2 ? [0, SIDE / 2] : [SIDE / 2, SIDE];
      for (let x = west + STEP * random(); x < east; x += STEP) {
        const from: Vector = [line, y + STEP * 0.3 * random(), FLIGHT_HEIGHT];
        const way = Math.hypot(x - line, FLIGHT_HEIGHT);
        const along: Vector = [(x - line) / way, 0, -FLIGHT_HEIGHT / way];
        const hit = whole(from, along, 2 * FLIGHT_HEIGHT);
        // Water is a mirror: it sends hardly anything back to the airplane.
        if (!hit || (hit.material === WATER && random() < 0.85)) continue;
        yield { from, along, hit, nth: 1, ...chance() };
        const second = hit.material === LEAVES && random() < 0.4 && bare(from, along, 2 * FLIGHT_HEIGHT);
        if (second) yield { from, along, hit: second, nth: 2, ...chance() };
      }
    }
  }
}

export function make(): LoadedCloud {
  const positions: number[] = [];
  const colors: number[] = [];
  const [intensity, classification, returnNumber]: [number[], number[], number[]] = [[], [], []];
  for (const { from, along, hit, nth, noise, light, shine } of fly()) {
    const { color, kind, gloss } = hit.material;
    const place = from.map((value, axis) => ORIGIN[axis]! + value + (hit.distance + noise) * along[axis]!);
    positions.push(...place.map((value) => Math.round(value * 1000) / 1000));
    const bright = (0.77 + 0.27 * hit.normal[2] - 0.17 * hit.normal[1]) * (0.93 + 0.14 * light);
    colors.push(...color.map((value) => Math.min(255, Math.round(value * bright))));
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

/** The land with its leaves, and the places that the beams met. */
export function truth(): Truth {
  const places: number[] = [];
  for (const { from, along, hit } of fly()) {
    places.push(...from.map((value, axis) => value + hit.distance * along[axis]!));
  }
  return { scene: makeLand(mulberry32(SEED)).whole, places: Float64Array.from(places), origin: ORIGIN };
}
