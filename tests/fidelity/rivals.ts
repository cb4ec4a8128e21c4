// Rules of others that take no surface either: buffers of ranges, and the ranges of neighbors in the picture.
import type { Point } from "../bench/measure.js";

type Positions = Float32Array | Float64Array;

/** Which points a buffer of the nearest ranges shows: those at most `tolerance` + 2 % behind the nearest one in their cell. */
export function buffered(positions: Positions, viewpoint: Point, cell: number, tolerance: number): Uint8Array {
  const { cells, ranges } = directions(positions, viewpoint, cell);
  const nearest = new Map<number, number>();
  cells.forEach((at, i) => {
    if (ranges[i]! < (nearest.get(at) ?? Infinity)) nearest.set(at, ranges[i]!);
  });
  return Uint8Array.from(cells, (at, i) => Number(ranges[i]! <= 1.02 * nearest.get(at)! + tolerance));
}

/**
 * After Biasutti et al., "Visibility estimation in point clouds with variable density" (2019): a point is visible if its range is
 * near the least range of its `count` neighbors in the picture, compared with how far their ranges spread.
 */
export function likeNeighbors(positions: Positions, viewpoint: Point, count = 8, threshold = 0.5): Uint8Array {
  const cell = Math.sqrt((24 * count) / positions.length);
  const { cells, ranges, places, width } = directions(positions, viewpoint, cell);
  const within = new Map<number, number[]>();
  cells.forEach((at, i) => {
    const list = within.get(at);
    if (list === undefined) within.set(at, [i]);
    else list.push(i);
  });
  return Uint8Array.from(cells, (at, i) => {
    // Neighbors on another face of the cube are left out.
    const near: [number, number][] = [];
    for (let ring = 1; near.length < count && ring <= 8; ring *= 2) {
      near.length = 0;
      for (let dy = -ring; dy <= ring; dy++) {
        for (let dx = -ring; dx <= ring; dx++) {
          for (const j of within.get(at + dy * width + dx) ?? []) {
            const apart = Math.hypot(places[2 * i]! - places[2 * j]!, places[2 * i + 1]! - places[2 * j + 1]!);
            if (j !== i && apart < cell * ring * 1.5) near.push([apart, ranges[j]!]);
          }
        }
      }
    }
    const all = near.sort(([a], [b]) => a - b).slice(0, count);
    const [least, most] = [Math.min, Math.max].map((of) => of(ranges[i]!, ...all.map(([, range]) => range)));
    const share = (ranges[i]! - least!) / (most! - least!);
    return Number(!(Math.exp(-share * share) < threshold));
  });
}

/** The range of each point, its place on a cube around the viewpoint, and the cell there. `cell` is in radians at a face's middle. */
function directions(positions: Positions, viewpoint: Point, cell: number) {
  const count = positions.length / 3;
  const width = Math.ceil(2 / cell) + 1;
  const [cells, ranges, places] = [new Float64Array(count), new Float64Array(count), new Float64Array(2 * count)];
  for (let i = 0; i < count; i++) {
    const v = viewpoint.map((x, axis) => positions[3 * i + axis]! - x);
    ranges[i] = Math.hypot(...v);
    const lengths = v.map(Math.abs);
    const axis = lengths.indexOf(Math.max(...lengths));
    const [x, y] = [v[(axis + 1) % 3]! / lengths[axis]!, v[(axis + 2) % 3]! / lengths[axis]!];
    const face = 2 * axis + Number(v[axis]! < 0);
    const [column, row] = [x, y].map((place) => Math.floor((place + 1) / cell));
    cells[i] = (face * width + row!) * width + column!;
    places.set([x, y], 2 * i);
  }
  return { cells, ranges, places, width };
}
