// Unevenly sampled surfaces that were made after the first rules had been chosen. Do not choose anything on them.
import {
  BoxGeometry,
  CapsuleGeometry,
  CatmullRomCurve3,
  ConeGeometry,
  ExtrudeGeometry,
  LatheGeometry,
  Path,
  Shape,
  SplineCurve,
  TubeGeometry,
  Vector2,
  Vector3,
} from "three";
import { ParametricGeometry } from "three/addons/geometries/ParametricGeometry.js";
import type { Mesh } from "../../www/samples/generator.js";
import { bumpySphere, scatter, torus } from "./shapes.js";
import { type Sampled, welded } from "./uneven.js";

export function* later(): Generator<Sampled> {
  for (const corners of [25, 400]) yield { name: `pawn, ${corners} corners`, mesh: pawn(corners) };
  yield { name: "helix of thin triangles", mesh: welded(new TubeGeometry(helix(), 1500, 0.12, 10)) };
  yield { name: "helix, 90 corners", mesh: welded(new TubeGeometry(helix(), 160, 0.12, 90)) };
  yield { name: "star prism", mesh: extruded(star(), 0.5, 20, 8) };
  yield { name: "rounded box with a bore", mesh: extruded(roundedBox(), 0.9, 30, 60) };
  yield { name: "cone of 500 corners", mesh: welded(new ConeGeometry(1, 2, 500, 12)) };
  yield { name: "capsule", mesh: welded(new CapsuleGeometry(0.5, 1.5, 12, 240)) };
  for (const [around, across] of [
    [300, 12],
    [30, 300],
  ] as const) {
    const mesh = welded(new ParametricGeometry(wavyRing, around, across));
    yield { name: `wavy ring, ${around} by ${across}`, mesh };
  }
  yield { name: "box, fine on two sides", mesh: welded(new BoxGeometry(1, 1, 1, 60, 60, 2)) };
  const [bumpy, ring] = [bumpySphere(), torus()];
  yield {
    name: "bumpy sphere, gradient",
    mesh: bumpy,
    points: scatter(bumpy, 30_000, 91, ([x, y]) => 40 ** ((x + y) / 3)),
  };
  const stripe = (x: number, z: number) => Math.sin(9 * Math.atan2(z, x)) > 0;
  yield {
    name: "torus, stripes 20:1",
    mesh: ring,
    points: scatter(ring, 30_000, 92, ([x, , z]) => (stripe(x, z) ? 20 : 1)),
  };
  const wave = (place: readonly number[]) => place.reduce((product, x) => product * Math.sin(6 * x), 1);
  yield {
    name: "bumpy sphere, spots 25:1",
    mesh: bumpy,
    points: scatter(bumpy, 30_000, 93, (place) => (wave(place) > 0.3 ? 25 : 1)),
  };
}

const PAWN = [
  [0, 0],
  [0.5, 0],
  [0.52, 0.08],
  [0.4, 0.2],
  [0.25, 0.35],
  [0.18, 0.8],
  [0.3, 0.9],
  [0.15, 1],
  [0.28, 1.2],
  [0.2, 1.45],
  [0, 1.52],
] as const;

function pawn(corners: number): Mesh {
  const profile = new SplineCurve(PAWN.map(([x, y]) => new Vector2(x, y)));
  return welded(new LatheGeometry(profile.getPoints(40), corners));
}

function helix(): CatmullRomCurve3 {
  const place = (t: number) => new Vector3(Math.cos(10 * Math.PI * t), 2 * t - 1, Math.sin(10 * Math.PI * t));
  return new CatmullRomCurve3(Array.from({ length: 201 }, (_, i) => place(i / 200)));
}

function star(): Shape {
  const at = (i: number): Vector2 => {
    const [away, turn] = [i % 2 === 0 ? 0.45 : 1, (2 * Math.PI * i) / 14];
    return new Vector2(away * Math.cos(turn), away * Math.sin(turn));
  };
  return new Shape(Array.from({ length: 14 }, (_, i) => at(i)));
}

function roundedBox(): Shape {
  const shape = new Shape()
    .moveTo(-1, -0.6)
    .lineTo(1, -0.6)
    .quadraticCurveTo(1.3, -0.6, 1.3, -0.3)
    .lineTo(1.3, 0.4)
    .quadraticCurveTo(1.3, 0.7, 1, 0.7)
    .lineTo(-1, 0.7)
    .quadraticCurveTo(-1.3, 0.7, -1.3, 0.4)
    .lineTo(-1.3, -0.3)
    .quadraticCurveTo(-1.3, -0.6, -1, -0.6);
  shape.holes.push(new Path().absellipse(0, 0, 0.6, 0.35, 0, 2 * Math.PI, true));
  return shape;
}

function extruded(shape: Shape, depth: number, steps: number, curveSegments: number): Mesh {
  const bevel = { bevelThickness: 0.05, bevelSize: 0.05, bevelSegments: 8 };
  return welded(new ExtrudeGeometry(shape, { depth, steps, curveSegments, ...bevel }));
}

function wavyRing(u: number, v: number, place: Vector3): void {
  const [around, across] = [2 * Math.PI * u, 2 * Math.PI * v];
  const away = 1.2 + 0.35 * Math.cos(across) * (1 + 0.3 * Math.sin(3 * around));
  const up = 0.35 * Math.sin(across) + 0.2 * Math.sin(2 * around);
  place.set(away * Math.cos(around), up, away * Math.sin(around));
}
