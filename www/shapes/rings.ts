import type { LoadedCloud } from "../cloud.ts";

/*
 * An airplane some 15 meters long as a designer might sketch it: nothing but rings of points, cross-sections far apart
 * compared with the points along them. Sparse and uneven, so that one sees through it between the rings. x is forward,
 * y up, z to the right.
 */

type Vector = [number, number, number];

/** A closed curve: a place for each turn from 0 to 1. */
type Ring = (turn: number) => Vector;

/** Along the fuselage: x, how far its middle is above 0, half its height and half its width. */
const FUSELAGE: [x: number, y: number, height: number, width: number][] = [
  [7.6, -0.1, 0.06, 0.06],
  [6.6, -0.05, 0.3, 0.28],
  [5.4, 0.0, 0.48, 0.44],
  [4.1, 0.1, 0.66, 0.56],
  [2.8, 0.28, 0.88, 0.62],
  [1.5, 0.25, 0.86, 0.72],
  [0.2, 0.12, 0.74, 0.86],
  [-1.2, 0.08, 0.7, 0.92],
  [-2.6, 0.06, 0.68, 0.9],
  [-4.0, 0.05, 0.64, 0.82],
  [-5.4, 0.05, 0.6, 0.68],
  [-6.8, 0.05, 0.5, 0.5],
];
const FUSELAGE_RINGS = 24;
const FUSELAGE_POINTS = 44;

/** A wing from its root to its tip: the leading edge, the chord backwards along x, and the thickness as a part of it. */
interface Wing {
  root: Vector;
  tip: Vector;
  chords: [number, number];
  thickness: number;
  rings: number;
  points: number;
}

const MAIN: Wing = { root: [2.2, -0.1, 0.7], tip: [-2.6, -0.25, 4.9], chords: [5.2, 1.3], thickness: 0.07, rings: 12, points: 34 };
const TAILPLANE: Wing = { root: [-4.9, 0.05, 0.55], tip: [-6.9, 0.0, 2.5], chords: [2.1, 0.8], thickness: 0.06, rings: 6, points: 24 };
const FIN: Wing = { root: [-4.3, 0.55, 0], tip: [-6.7, 2.6, 0], chords: [2.7, 1.0], thickness: 0.07, rings: 8, points: 30 };

export function makeRings(): LoadedCloud {
  const sections: [Ring, number][] = [
    ...fuselage().map((ring): [Ring, number] => [ring, FUSELAGE_POINTS]),
    ...[MAIN, mirrored(MAIN), TAILPLANE, mirrored(TAILPLANE), FIN].flatMap((wing) => ribs(wing).map((ring): [Ring, number] => [ring, wing.points])),
  ];
  const points = sections.flatMap(([ring, count]) => Array.from({ length: count }, (_, i) => ring(i / count)));
  return { positions: Float32Array.from(points.flat()), colors: null };
}

function fuselage(): Ring[] {
  const [nose, tail] = [FUSELAGE[0]![0], FUSELAGE.at(-1)![0]];
  return Array.from({ length: FUSELAGE_RINGS }, (_, i) => {
    const x = nose + ((tail - nose) * i) / (FUSELAGE_RINGS - 1);
    const behind = Math.max(1, FUSELAGE.findIndex((station) => station[0] <= x + 1e-9));
    const [a, b] = [FUSELAGE[behind - 1]!, FUSELAGE[behind]!];
    const share = (a[0] - x) / (a[0] - b[0]);
    const [y, height, width] = ([1, 2, 3] as const).map((column) => a[column] + share * (b[column] - a[column])) as Vector;
    return (turn) => [x, y + height * Math.cos(2 * Math.PI * turn), width * Math.sin(2 * Math.PI * turn)];
  });
}

function ribs({ root, tip, chords, thickness, rings }: Wing): Ring[] {
  // A fin stands upright: its thickness is along z, a wing's along y.
  const across = Math.abs(tip[1] - root[1]) > Math.abs(tip[2] - root[2]) ? 2 : 1;
  return Array.from({ length: rings }, (_, i) => {
    const share = i / (rings - 1);
    const edge = root.map((value, axis) => value + share * (tip[axis]! - value)) as Vector;
    const chord = chords[0] + share * (chords[1] - chords[0]);
    return (turn) => {
      // Rounded in front, sharp behind.
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
