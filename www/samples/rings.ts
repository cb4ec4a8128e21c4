import type { LoadedCloud } from "../cloud/cloud.ts";
import type { Truth } from "./generator.ts";

/*
 * An airplane about 15 meters long, as a designer might sketch it. It consists only of rings of points: cross-sections
 * that are far apart, with points close together on each. It is sparse and uneven: one can look through between the
 * rings. x is forward, y up, z to the right.
 */

type Vector = [number, number, number];

/** A closed curve: the place for each part of the turn, from 0 to 1. */
type Ring = (turn: number) => Vector;

/** Along the fuselage: x, the height of its middle, half its height and half its width. */
const FUSELAGE: [x: number, y: number, height: number, width: number][] = [
  [7.0, -0.15, 0.12, 0.12],
  [6.2, -0.12, 0.42, 0.4],
  [5.2, -0.05, 0.68, 0.62],
  [4.1, 0.12, 0.98, 0.78],
  [2.8, 0.3, 1.24, 0.9],
  [1.5, 0.26, 1.2, 1.04],
  [0.2, 0.14, 1.06, 1.2],
  [-1.2, 0.1, 1.0, 1.26],
  [-2.6, 0.08, 0.98, 1.22],
  [-4.0, 0.06, 0.94, 1.1],
  [-5.4, 0.05, 0.88, 0.94],
  [-6.8, 0.05, 0.78, 0.78],
];
const FUSELAGE_RINGS = 40;
const FUSELAGE_POINTS = 26;

/** A wing from its root to its tip: the leading edge, the chord backwards along x, and the thickness as a share of it. */
interface Wing {
  root: Vector;
  tip: Vector;
  chords: [number, number];
  thickness: number;
  rings: number;
  points: number;
}

const MAIN: Wing = {
  root: [2.4, -0.1, 1.1],
  tip: [-2.4, -0.25, 5.4],
  chords: [5.4, 1.6],
  thickness: 0.11,
  rings: 13,
  points: 32,
};
const TAILPLANE: Wing = {
  root: [-4.6, 0.05, 0.9],
  tip: [-6.6, 0.0, 3.0],
  chords: [2.4, 1.1],
  thickness: 0.1,
  rings: 8,
  points: 20,
};
const FIN: Wing = {
  root: [-3.9, 0.8, 0],
  tip: [-6.4, 3.2, 0],
  chords: [3.1, 1.3],
  thickness: 0.1,
  rings: 10,
  points: 22,
};

/** A part with one skin: its rings in a row, and the number of points of each. */
interface Body {
  rings: Ring[];
  points: number;
}

export function make(): LoadedCloud {
  const points = bodies().flatMap(({ rings, points: count }) =>
    rings.flatMap((ring) => Array.from({ length: count }, (_, i) => ring(i / count))),
  );
  return { positions: Float32Array.from(points.flat()), colors: null };
}

export function truth(): Truth {
  return { mesh: { positions: make().positions as Float32Array, triangles: skinOfRings() }, on: null };
}

/** The skin of the airplane: triangles between neighboring rings, and over the first and the last ring of each body. */
export function skinOfRings(): Uint32Array {
  const triangles: number[] = [];
  let first = 0;
  for (const { rings, points: count } of bodies()) {
    const last = first + (rings.length - 1) * count;
    for (let ring = first; ring < last; ring += count) {
      for (let i = 0; i < count; i++) {
        const [a, b] = [ring + i, ring + ((i + 1) % count)];
        triangles.push(a, b, a + count, a + count, b, b + count);
      }
    }
    for (const end of [first, last]) for (let i = 2; i < count; i++) triangles.push(end, end + i - 1, end + i);
    first = last + count;
  }
  return Uint32Array.from(triangles);
}

function bodies(): Body[] {
  const wings = [MAIN, mirrored(MAIN), TAILPLANE, mirrored(TAILPLANE), FIN];
  return [
    { rings: fuselage(), points: FUSELAGE_POINTS },
    ...wings.map((wing) => ({ rings: ribs(wing), points: wing.points })),
  ];
}

function fuselage(): Ring[] {
  const [nose, tail] = [FUSELAGE[0]![0], FUSELAGE.at(-1)![0]];
  return Array.from({ length: FUSELAGE_RINGS }, (_, i) => {
    const x = nose + ((tail - nose) * i) / (FUSELAGE_RINGS - 1);
    const behind = Math.max(
      1,
      FUSELAGE.findIndex((station) => station[0] <= x + 1e-9),
    );
    const [a, b] = [FUSELAGE[behind - 1]!, FUSELAGE[behind]!];
    const share = (a[0] - x) / (a[0] - b[0]);
    const [y, height, width] = ([1, 2, 3] as const).map(
      (column) => a[column] + share * (b[column] - a[column]),
    ) as Vector;
    return (turn) => [x, y + height * Math.cos(2 * Math.PI * turn), width * Math.sin(2 * Math.PI * turn)];
  });
}

function ribs({ root, tip, chords, thickness, rings }: Wing): Ring[] {
  // A fin stands upright, so its thickness is along z. The thickness of a wing is along y.
  const across = Math.abs(tip[1] - root[1]) > Math.abs(tip[2] - root[2]) ? 2 : 1;
  return Array.from({ length: rings }, (_, i) => {
    const share = i / (rings - 1);
    const edge = root.map((value, axis) => value + share * (tip[axis]! - value)) as Vector;
    const chord = chords[0] + share * (chords[1] - chords[0]);
    return (turn) => {
      // The cross-section is round in front and sharp behind.
      const back = (1 - Math.cos(2 * Math.PI * turn)) / 2;
      const half = chord * thickness * 1.5 * (Math.sqrt(back) - back) * Math.sign(0.5 - turn);
      const place: Vector = [edge[0] - back * chord, edge[1], edge[2]];
      place[across] += half;
      return place;
    };
  });
}

function mirrored(wing: Wing): Wing {
  const flip = ([x, y, z]: Vector): Vector => [x, y, -z];
  return { ...wing, root: flip(wing.root), tip: flip(wing.tip) };
}
