import type { LoadedCloud } from "../cloud/cloud.ts";
import type { Solid, Vector } from "./trace.ts";

/** A module that makes a sample: the same points on every machine. */
export interface Generator {
  make: () => LoadedCloud;
  /** The surface that the points were taken from. Some samples have none. */
  truth?: () => Truth;
}

/**
 * A surface, and for each point of the cloud its place on it. The points are the vertices of the mesh, or lie on its
 * faces, or lie on the solids of a scene. Rays can be traced in this scene.
 */
export type Truth =
  | { mesh: Mesh; on: OnFaces | null }
  // `origin`: where the scene has its zero, in the coordinates of the cloud.
  | { scene: Solid<unknown>; places: Float64Array; origin?: Vector };

/** Points on a mesh that are not its vertices, each with the number of the face it lies on. */
export interface OnFaces {
  positions: Float32Array;
  faces: Uint32Array;
}

export interface Mesh {
  positions: Float32Array;
  /** Three indices for each triangle. */
  triangles: Uint32Array;
}

/** A piece of surface in columns and rows of rectangles, each cut in two. `at` takes two numbers from 0 to 1. */
export function grid(columns: number, rows: number, at: (u: number, v: number) => readonly number[]): Mesh {
  const positions = new Float32Array(3 * (columns + 1) * (rows + 1));
  const triangles = new Uint32Array(6 * columns * rows);
  for (let row = 0; row <= rows; row++) {
    for (let column = 0; column <= columns; column++) {
      const corner = row * (columns + 1) + column;
      positions.set(at(column / columns, row / rows), 3 * corner);
      if (row === rows || column === columns) continue;
      const [right, up] = [corner + 1, corner + columns + 1];
      triangles.set([corner, right, up, up, right, up + 1], 6 * (row * columns + column));
    }
  }
  return { positions, triangles };
}

/** Several meshes as one. */
export function joined(meshes: readonly Mesh[]): Mesh {
  const positions = new Float32Array(meshes.reduce((sum, mesh) => sum + mesh.positions.length, 0));
  const triangles = new Uint32Array(meshes.reduce((sum, mesh) => sum + mesh.triangles.length, 0));
  let [point, corner] = [0, 0];
  for (const mesh of meshes) {
    positions.set(mesh.positions, 3 * point);
    triangles.set(
      mesh.triangles.map((index) => index + point),
      corner,
    );
    point += mesh.positions.length / 3;
    corner += mesh.triangles.length;
  }
  return { positions, triangles };
}

/** Tommy Ettinger's mulberry32: 32 bits of state, and the same numbers from 0 to 1 on every machine. */
export function mulberry32(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/** Nearly a normal distribution: the sum of four uniform random numbers. */
export function gaussian(random: () => number): number {
  return (random() + random() + random() + random() - 2) * Math.sqrt(3);
}
