// Structured clouds, where points coincide, or lie on one line or in one plane, and places in and on them.
import fc from "fast-check";
import { type Argument, dressed, named } from "./argument.js";

export type Place = readonly [number, number, number];

export interface Scene {
  name: string;
  points: Argument<readonly number[]>;
  /** Some points have coordinates that are not finite, and the cloud skips them. */
  skips: boolean;
  length: number;
  /** Viewpoints on points, between points, in the planes of walls, inside and outside. */
  place: fc.Arbitrary<Place>;
}

/** Small whole numbers. Every typed array holds them. Many points coincide, or lie on one line or in one plane. */
const coordinate = fc.oneof(
  { weight: 4, arbitrary: fc.integer({ min: 0, max: 6 }) },
  { weight: 1, arbitrary: fc.double({ noNaN: true, min: -9, max: 9 }) },
);

export function coordinates(dimension: number, most: number): fc.Arbitrary<number[]> {
  const point = fc.array(coordinate, { minLength: dimension, maxLength: dimension });
  return fc.array(point, { maxLength: most }).map((points) => points.flat());
}

const range = (count: number) => [...Array(count).keys()];
const grid = (count: number) => range(count).flatMap((i) => range(count).map((j) => [i, j] as const));
const isWall = (place: Place) => place.some((x) => x === 0 || x === 6);
const lattice = (count: number) => grid(count).flatMap(([i, j]) => range(count).map((k): Place => [i, j, k]));

/** Points all over a sphere, in general position. There are enough of them to keep several workers busy. */
function ball(count: number): Place[] {
  return range(count).map((i) => {
    const z = 1 - (2 * i + 1) / count;
    const r = Math.sqrt(1 - z * z);
    return [3 * r * Math.cos(2.4 * i), 3 * r * Math.sin(2.4 * i), 3 * z];
  });
}

/** The points as triples, by name. */
const SHAPES: Record<string, readonly Place[]> = {
  "no point": [],
  "one point": [[1, 2, 3]],
  "two points": [[0, 0, 1], [0, 0, 5]],
  "a line": range(24).map((i): Place => [i % 12, i % 12, 0]),
  "a plane": grid(9).map(([i, j]): Place => [i, j, 2]),
  "two planes": grid(8).flatMap(([i, j]): Place[] => [[i, j, 2], [i, j, 5]]),
  "a room": lattice(7).filter(isWall),
  "a lattice": lattice(5),
  "points eight times": range(80).map((i): Place => [i % 5, (i % 5) ** 2 % 7, (i % 10) % 3]),
  "a ball": ball(1500),
}; // prettier-ignore

const shape = fc.oneof(
  { weight: 4, arbitrary: fc.constantFrom(...Object.entries(SHAPES)).map(([name, triples]) => ({ name, triples })) },
  {
    weight: 1,
    arbitrary: coordinates(3, 40).map((numbers) => ({ name: "points anywhere", triples: triplesOf(numbers) })),
  },
);

function triplesOf(numbers: readonly number[]): readonly Place[] {
  return range(numbers.length / 3).map((i) => numbers.slice(3 * i, 3 * i + 3) as unknown as Place);
}

/** How the coordinates are moved: not at all, or to coordinates of a map. */
const MOVES: readonly Place[] = [[0, 0, 0], [0, 0, 0], [512_345.25, 5_403_209.5, 450]]; // prettier-ignore

export const scene: fc.Arbitrary<Scene> = fc
  .record({ shape, move: fc.constantFrom(...MOVES), skips: fc.nat({ max: 3 }).map((n) => n === 0) })
  .chain(({ shape: { name, triples }, move, skips }) => {
    const moved = triples.map((point) => point.map((x, axis) => x + move[axis]!) as unknown as Place);
    const spoiled = skips
      ? moved.map((point, i) => (i % 4 === 1 ? ([NaN, point[1], Infinity] as const) : point))
      : moved;
    return named(
      dressed(spoiled.flat()).map((points): Scene => ({
        name: `${name}, moved by ${move.join(", ")}${skips ? ", some skipped" : ""}`,
        points: { ...points, name: points.name.split(" of [")[0]! },
        skips,
        length: moved.length,
        place: placeIn(moved, move),
      })),
    );
  });

function placeIn(points: readonly Place[], move: Place): fc.Arbitrary<Place> {
  const point = points.length === 0 ? fc.constant(move) : fc.nat({ max: points.length - 1 }).map((i) => points[i]!);
  const between = fc.tuple(point, point).map(([a, b]) => a.map((x, axis) => (x + b[axis]!) / 2) as unknown as Place);
  const inPlane = fc
    .tuple(point, fc.nat({ max: 2 }), fc.constantFrom(-20, -0.5, 0.25, 3, 11))
    .map(([from, axis, step]) => from.map((x, i) => (i === axis ? x + step : x)) as unknown as Place);
  const anywhere = fc
    .tuple(...[0, 1, 2].map(() => fc.integer({ min: -12, max: 12 })))
    .map((steps) => steps.map((x, axis) => x + move[axis]!) as unknown as Place);
  return fc.oneof(point, between, inPlane, anywhere);
}
