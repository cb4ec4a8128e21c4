// three.js' hull in a process of its own, so that it can be stopped: hull-peer.js CLOUD X,Y,Z RADIUS OUT.
// OUT receives the numbers of the hull's vertices as little-endian u32. The last number is the viewpoint.
// Prints the milliseconds of the hull alone, without the preparation of its input.
// Short runs are repeated, so that the code gets compiled.
import { writeFileSync } from "node:fs";

import { Vector3 } from "three";
import { ConvexHull } from "three/examples/jsm/math/ConvexHull.js";

import { flip } from "./flip.js";
import type { Point } from "./measure.js";
import { readCloud } from "./paths.js";

const RUNS = 5;
const ENOUGH_MS = 3000;

const [file, viewpoint, radius, out] = process.argv.slice(2);
const q = flip(readCloud(file!), viewpoint!.split(",").map(Number) as Point, Number(radius));
const numbers = new Map<Vector3, number>();
for (let i = 0; i < q.length; i += 3) numbers.set(new Vector3(q[i], q[i + 1], q[i + 2]), i / 3);
numbers.set(new Vector3(), q.length / 3);
const points = [...numbers.keys()];

const milliseconds: number[] = [];
let hull = new ConvexHull();
const started = performance.now();
while (milliseconds.length === 0 || (milliseconds.length < RUNS && performance.now() - started < ENOUGH_MS)) {
  const start = performance.now();
  hull = new ConvexHull().setFromPoints(points);
  milliseconds.push(performance.now() - start);
}
const vertices = new Set<number>();
for (const { edge } of hull.faces) {
  let at = edge;
  do {
    vertices.add(numbers.get(at.head().point)!);
    at = at.next;
  } while (at !== edge);
}
writeFileSync(out!, Uint32Array.from(vertices));
console.log(JSON.stringify(milliseconds));
