import type { LoadedCloud } from "../cloud/cloud.ts";
import type { Truth } from "./generator.ts";
import { mulberry32 } from "./random.ts";
import { makeScene, type Material } from "./street-scene.ts";
import type { Hit, Vector } from "./trace.ts";

/*
 * A street of 70 meters with houses, trees and parked cars, as a terrestrial laser scanner sees it from three places.
 * The rays have even steps of both angles. Each ray makes one point, at its first hit. Glass lets most rays through. So
 * there are points of the rooms behind the façades. Through the walls, nobody in the street would see these points.
 * Units are meters; x is along the street, z up. The seed is fixed: the points are the same on every machine.
 */

const SEED = 2007;
const STATIONS: Vector[] = [
  [-21, 1.1, 1.75],
  [0.5, -1.3, 1.75],
  [22, 0.9, 1.75],
];
const TURNS = 500;
const STEPS = 158;
/** The angles of the lowest and the highest ray, in degrees. */
const LOWEST = -42;
const HIGHEST = 58;
const REACH = 48;
/** One standard deviation of the measured distance, in meters. */
const NOISE = 0.004;
/** The share of the beams that a pane sends back. */
const PANE = 0.06;

const LABELS = {
  2: "ground",
  5: "high vegetation",
  6: "building",
  11: "road",
  64: "vehicle",
  65: "street furniture",
  66: "behind glass",
};

export function make(): LoadedCloud {
  const most = STATIONS.length * TURNS * STEPS;
  const positions = new Float32Array(3 * most);
  const colors = new Uint8Array(3 * most);
  const intensity = new Uint8Array(most);
  const classification = new Uint8Array(most);
  let count = 0;
  for (const { from, along, hit, measured, light, grain } of scan()) {
    const { color, kind, gloss } = hit.material;
    for (let axis = 0; axis < 3; axis++) {
      positions[3 * count + axis] = from[axis]! + measured * along[axis]!;
      colors[3 * count + axis] = Math.min(255, color[axis]! * light);
    }
    const slant = Math.abs(along[0] * hit.normal[0] + along[1] * hit.normal[1] + along[2] * hit.normal[2]);
    intensity[count] = Math.min(
      255,
      gloss * (0.25 + 0.75 * slant) * (0.92 + 0.16 * grain) * Math.min(1, 22 / (10 + hit.distance)) * 255,
    );
    classification[count] = kind;
    count++;
  }
  return {
    positions: positions.slice(0, 3 * count),
    colors: colors.slice(0, 3 * count),
    facts: { crs: { name: "Its own", unit: { name: "m", meters: 1 }, heightUnit: null, isAngular: false } },
    attributes: [
      { name: "intensity", kind: "scalar", values: intensity.slice(0, count) },
      { name: "classification", kind: "category", values: classification.slice(0, count), labels: LABELS },
    ],
  };
}

/** Everything that was scanned, with panes that one can look through, and the places that the beams met. */
export function truth(): Truth {
  const places: number[] = [];
  for (const { from, along, hit } of scan()) {
    places.push(...from.map((value, axis) => value + hit.distance * along[axis]!));
  }
  return { scene: makeScene(mulberry32(SEED), () => true), places: Float64Array.from(places) };
}

/** Every beam that comes back, with the measured distance. */
function* scan(): Generator<{
  from: Vector;
  along: Vector;
  hit: Hit<Material>;
  measured: number;
  light: number;
  grain: number;
}> {
  const random = mulberry32(SEED);
  const scene = makeScene(random, () => random() >= PANE);
  for (const from of STATIONS) {
    for (let turn = 0; turn < TURNS; turn++) {
      for (let step = 0; step < STEPS; step++) {
        const around = (2 * Math.PI * (turn + 0.4 * random())) / TURNS;
        const up = ((LOWEST + ((HIGHEST - LOWEST) * (step + 0.4 * random())) / STEPS) * Math.PI) / 180;
        const along: Vector = [Math.cos(up) * Math.cos(around), Math.cos(up) * Math.sin(around), Math.sin(up)];
        const hit = scene(from, along, REACH);
        if (!hit) continue;
        const measured = hit.distance + NOISE * gaussian(random);
        yield { from, along, hit, measured, light: shade(hit.normal, hit.material, random), grain: random() };
      }
    }
  }
}

/** Soft daylight from the south and from above. Rooms are darker. */
function shade(normal: Vector, { kind }: Material, random: () => number): number {
  const light =
    0.84 + 0.16 * normal[2] + 0.14 * Math.max(0, 0.5 * normal[0] - 0.86 * normal[1]) + 0.06 * (random() - 0.5);
  return kind === 66 ? 0.8 * light : light;
}

/** Nearly a normal distribution: the sum of four uniform random numbers. */
function gaussian(random: () => number): number {
  return (random() + random() + random() + random() - 2) * Math.sqrt(3);
}
