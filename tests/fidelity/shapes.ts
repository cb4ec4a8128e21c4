// Generated surfaces, as meshes, and points scattered over their faces.
import { grid, joined, type Mesh } from "../../www/samples/generator.js";
import { roomSurfaces } from "../../www/samples/living-room.js";
import { bumpyRadius, direction, seeded } from "../bench/generators.js";
import type { Point } from "../bench/measure.js";
import type { MeshPoints } from "./rays.js";

/** A horizontal ring of radius 1 and thickness 0.8. */
export function torus(): Mesh {
  const thick = 0.4;
  return grid(240, 100, (u, v) => {
    const [turn, around] = [2 * Math.PI * u, 2 * Math.PI * v];
    const away = 1 + thick * Math.cos(around);
    return [away * Math.cos(turn), away * Math.sin(turn), thick * Math.sin(around)];
  });
}

/** The benchmark's closed surface with bumps and dents. */
export function bumpySphere(): Mesh {
  const radius = bumpyRadius();
  return grid(480, 240, (u, v) => {
    const along = direction(-Math.cos(Math.PI * v), u);
    return along.map((x) => x * radius(along));
  });
}

/** The page's living room, seen from inside: open surfaces and thin objects. */
export function room(): Mesh {
  return joined(roomSurfaces(seeded(20070802)).map((surface) => grid(12, 8, (u, v) => surface.at(u, v).point)));
}

/** `count` random points on the faces. `density` gives each place a weight. By default all are equal. */
export function scatter(
  mesh: Mesh,
  count: number,
  seed: number,
  density: (place: Point) => number = () => 1,
): MeshPoints {
  const random = seeded(seed);
  const corners = (face: number) => Array.from({ length: 3 }, (_, i) => corner(mesh, 3 * face + i));
  const weights = Float64Array.from({ length: mesh.triangles.length / 3 }, (_, face) => {
    const [a, b, c] = corners(face) as [Point, Point, Point];
    return area(a, b, c) * density(a.map((x, axis) => (x + b[axis]! + c[axis]!) / 3) as Point);
  });
  const step = weights.reduce((sum, weight) => sum + weight, 0) / count;
  const positions = new Float64Array(3 * count);
  const faces = new Uint32Array(count);
  let [face, passed] = [0, weights[0]!];
  for (let i = 0; i < count; i++) {
    // One point in each equal share of the total, so that no place stays empty by chance.
    const at = (i + random()) * step;
    while (at > passed && face + 1 < weights.length) passed += weights[++face]!;
    faces[i] = face;
    positions.set(within(corners(face), random(), random()), 3 * i);
  }
  return { positions, faces };
}

function corner({ positions, triangles }: Mesh, i: number): Point {
  const at = 3 * triangles[i]!;
  return [positions[at]!, positions[at + 1]!, positions[at + 2]!];
}

function area(a: Point, b: Point, c: Point): number {
  const [u, v] = [b, c].map((p) => p.map((x, axis) => x - a[axis]!)) as [Point, Point];
  return Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
}

/** A point of a triangle. Two uniform numbers in 0 … 1 give a uniform point. */
function within(corners: Point[], u: number, v: number): Point {
  const [a, b] = u + v > 1 ? [1 - u, 1 - v] : [u, v];
  return [0, 1, 2].map((axis) => {
    const [p, q, r] = corners.map((place) => place[axis]!) as Point;
    return p + a * (q - p) + b * (r - p);
  }) as Point;
}
