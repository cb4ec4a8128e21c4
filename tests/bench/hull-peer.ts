// A JavaScript hull in a process of its own, so that it can be stopped:
// hull-peer.js three|quickhull3d CLOUD X,Y,Z RADIUS OUT. OUT receives the numbers of
// the hull's vertices as little-endian u32. The last number is the viewpoint.
// Prints the milliseconds of the hull alone, without the preparation of its input.
// Short runs are repeated, so that the code gets compiled.
import { writeFileSync } from "node:fs";

import type * as Quickhull3d from "quickhull3d";
import { Vector3 } from "three";
import { ConvexHull } from "three/examples/jsm/math/ConvexHull.js";

import { flip } from "./flip.js";
import type { Point } from "./measure.js";
import { readCloud } from "./paths.js";

// Node can load only this file of quickhull3d. The file has no types of its own.
const bundle = "quickhull3d/dist/quickhull3d.js";
const { default: quickhull3d } = (await import(bundle)) as typeof Quickhull3d;

const RUNS = 5;
const ENOUGH_MS = 3000;
const HULLS: Record<string, (q: Float64Array) => () => Iterable<number>> = { three, quickhull3d: quickhull };

const [peer, file, viewpoint, radius, out] = process.argv.slice(2);
const flipped = flip(readCloud(file!), viewpoint!.split(",").map(Number) as Point, Number(radius));
const hull = HULLS[peer!]!(flipped);
const milliseconds: number[] = [];
let vertices: Iterable<number> = [];
const started = performance.now();
while (milliseconds.length === 0 || (milliseconds.length < RUNS && performance.now() - started < ENOUGH_MS)) {
  const start = performance.now();
  vertices = hull();
  milliseconds.push(performance.now() - start);
}
writeFileSync(out!, Uint32Array.from(vertices));
console.log(JSON.stringify(milliseconds));

function three(q: Float64Array): () => Iterable<number> {
  const numbers = new Map<Vector3, number>();
  for (let i = 0; i <= q.length / 3; i++) numbers.set(new Vector3(...pointOf(q, i)), i);
  const points = [...numbers.keys()];
  return () => {
    const { faces } = new ConvexHull().setFromPoints(points);
    const found = new Set<number>();
    for (const { edge } of faces) {
      let at = edge;
      do {
        found.add(numbers.get(at.head().point)!);
        at = at.next;
      } while (at !== edge);
    }
    return found;
  };
}

function quickhull(q: Float64Array): () => Iterable<number> {
  const points = Array.from({ length: q.length / 3 + 1 }, (_, i) => pointOf(q, i));
  return () => new Set(quickhull3d(points).flat());
}

/** The flipped points, and after them the viewpoint. */
function pointOf(q: Float64Array, i: number): Point {
  return 3 * i < q.length ? [q[3 * i]!, q[3 * i + 1]!, q[3 * i + 2]!] : [0, 0, 0];
}
