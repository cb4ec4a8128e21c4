// Surfaces that are sampled unevenly: parts like those from CAD programs, whose points are the
// corners of long, thin triangles; surfaces turned from few and many rings; patches of other
// density; levels of detail; decimated scans.
import {
  BufferAttribute,
  BufferGeometry,
  ExtrudeGeometry,
  LatheGeometry,
  Path,
  Shape,
  TorusKnotGeometry,
  Vector2,
} from "three";
import { TeapotGeometry } from "three/addons/geometries/TeapotGeometry.js";
import { SimplifyModifier } from "three/addons/modifiers/SimplifyModifier.js";
import { mergeVertices } from "three/addons/utils/BufferGeometryUtils.js";
import { grid, type Mesh } from "../../www/samples/generator.js";
import { bumpyRadius, direction, seeded } from "../bench/generators.js";
import type { Point } from "../bench/measure.js";
import type { MeshPoints } from "./rays.js";
import { bumpySphere, scatter, torus } from "./shapes.js";

export interface Sampled {
  name: string;
  mesh: Mesh;
  /** Without points: the mesh's corners. */
  points?: MeshPoints;
}

/** Two sets of other shapes, proportions and seeds: one to choose rules on, and one to report them on. */
export const HALVES = ["first half", "second half"] as const;
export type Half = (typeof HALVES)[number];

export function* uneven(half: Half): Generator<Sampled> {
  const chosen = half === HALVES[0];
  yield { name: "plate with holes", mesh: plate(chosen ? 5 : 8, chosen ? 96 : 60, chosen ? 1 : 2) };
  yield { name: "gear", mesh: gear(chosen ? 24 : 40, chosen ? 12 : 7) };
  yield { name: "turned vase", mesh: vase(chosen ? 90 : 140, chosen ? 3 : 4) };
  yield { name: "bumps, dense to one pole", mesh: poles(chosen ? 260 : 180, chosen ? 1.6 : 2.2) };
  if (chosen) yield { name: "torus knot, thin triangles", mesh: knot(2, 3, 900, 12) };
  else yield { name: "teapot, thin triangles", mesh: welded(new TeapotGeometry(1, 14)) };
  const ring = torus();
  const bumpy = bumpySphere();
  const patch = (axis: number, times: number) => (place: Point) => (place[axis]! > 0.25 ? times : 1);
  if (chosen) yield { name: "torus, a patch 16:1", mesh: ring, points: scatter(ring, 20_000, 31, patch(0, 16)) };
  else yield { name: "torus, a patch 30:1", mesh: ring, points: scatter(ring, 24_000, 41, patch(1, 30)) };
  if (chosen) {
    yield { name: "bumpy sphere, halves 12:1", mesh: bumpy, points: scatter(bumpy, 20_000, 32, patch(2, 12)) };
  } else {
    yield { name: "bumpy sphere, levels", mesh: bumpy, points: scatter(bumpy, 30_000, 42, levels) };
  }
}

/** Four levels of detail. Each has a quarter of the density of the one before. */
function levels([x]: Point): number {
  return 4 ** Math.floor(2 * (x + 1));
}

/** The vertices of a scan that was decimated to a share of its points: few where it is flat. */
export async function decimated(name: string, mesh: Mesh, share: number): Promise<Sampled> {
  const geometry = geometryOf(mesh);
  const count = mesh.positions.length / 3;
  const simple = await new SimplifyModifier().modify(geometry, Math.round(count * (1 - share)));
  return { name: `${name}, decimated to ${100 * share} %`, mesh: welded(simple) };
}

/** A plate with round holes and a rounded rim: its flat sides have no points inside. */
function plate(holes: number, corners: number, seed: number): Mesh {
  const random = seeded(seed);
  const shape = new Shape()
    .moveTo(-2, -1)
    .lineTo(2, -1)
    .absarc(2, 0, 1, -Math.PI / 2, Math.PI / 2, false);
  shape.lineTo(-2, 1).absarc(-2, 0, 1, Math.PI / 2, (3 * Math.PI) / 2, false);
  for (let i = 0; i < holes; i++) {
    const x = -2.2 + (4.4 * (i + 0.5)) / holes;
    const radius = (0.35 + 0.5 * random()) * (2.2 / holes);
    shape.holes.push(new Path().absarc(x, 0.4 * random() - 0.2, radius, 0, 2 * Math.PI, true));
  }
  return welded(
    new ExtrudeGeometry(shape, {
      depth: 0.5,
      steps: 3,
      curveSegments: corners,
      bevelThickness: 0.08,
      bevelSize: 0.08,
      bevelSegments: 6,
    }),
  );
}

/** A gear wheel with a bore. Its teeth have many points, its sides none. */
function gear(teeth: number, steps: number): Mesh {
  const at = (i: number): Vector2 => {
    const turn = (2 * Math.PI * i) / (4 * teeth);
    const away = i % 4 < 2 ? 1 : 1.18;
    return new Vector2(away * Math.cos(turn), away * Math.sin(turn));
  };
  const shape = new Shape(Array.from({ length: 4 * teeth }, (_, i) => at(i)));
  shape.holes.push(new Path().absarc(0, 0, 0.35, 0, 2 * Math.PI, true));
  return welded(
    new ExtrudeGeometry(shape, {
      depth: 0.6,
      steps,
      curveSegments: 64,
      bevelThickness: 0.04,
      bevelSize: 0.03,
      bevelSegments: 3,
    }),
  );
}

/** A vase, turned from rings of many corners that are far from each other where the wall is straight. */
function vase(corners: number, waves: number): Mesh {
  const profile = Array.from({ length: 61 }, (_, i) => {
    const u = i / 60;
    // Heights crowd at the foot and the neck.
    const height = u - Math.sin(4 * Math.PI * u) / (4.6 * Math.PI);
    return new Vector2(0.5 + 0.3 * Math.sin(waves * Math.PI * height), 2.4 * height);
  });
  return welded(new LatheGeometry(profile, corners));
}

/** The benchmark's bumpy shape, as a grid whose rows crowd at one pole. */
function poles(columns: number, crowded: number): Mesh {
  const radius = bumpyRadius();
  return welded(
    geometryOf(
      grid(columns, Math.round(columns / 2.5), (u, v) => {
        const along = direction(-Math.cos(Math.PI * v ** crowded), u);
        return along.map((x) => x * radius(along));
      }),
    ),
  );
}

/** A knot of a thick rope: many rings, each with few corners. */
function knot(p: number, q: number, rings: number, corners: number): Mesh {
  return welded(new TorusKnotGeometry(1, 0.32, rings, corners, p, q));
}

function geometryOf({ positions, triangles }: Mesh): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  geometry.setIndex(new BufferAttribute(triangles, 1));
  return geometry;
}

/** The mesh without normals, with one point for each place, and without triangles that have no area. */
export function welded(geometry: BufferGeometry): Mesh {
  const bare = new BufferGeometry();
  bare.setAttribute("position", geometry.getAttribute("position"));
  bare.setIndex(geometry.getIndex());
  const merged = mergeVertices(bare, 1e-6);
  const all = Uint32Array.from(merged.getIndex()!.array);
  const triangles = all.filter((_, i) => {
    const [a, b, c] = all.subarray(i - (i % 3), i - (i % 3) + 3);
    return a !== b && b !== c && c !== a;
  });
  return { positions: Float32Array.from(merged.getAttribute("position").array), triangles };
}
