import type { LoadedCloud } from "../cloud/cloud.ts";
import { mulberry32 } from "./random.ts";
import { makeLand, type Return } from "./tile-land.ts";

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
