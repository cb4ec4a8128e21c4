// The usual rule that takes no surface either: a buffer of ranges.
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

/** The range of each point, and its cell on a cube around the viewpoint. `cell` is in radians at a face's middle. */
function directions(positions: Positions, viewpoint: Point, cell: number) {
  const count = positions.length / 3;
  const width = Math.ceil(2 / cell) + 1;
  const [cells, ranges] = [new Float64Array(count), new Float64Array(count)];
  for (let i = 0; i < count; i++) {
    const v = viewpoint.map((x, axis) => positions[3 * i + axis]! - x);
    ranges[i] = Math.hypot(...v);
    const lengths = v.map(Math.abs);
    const axis = lengths.indexOf(Math.max(...lengths));
    const [x, y] = [v[(axis + 1) % 3]! / lengths[axis]!, v[(axis + 2) % 3]! / lengths[axis]!];
    const face = 2 * axis + Number(v[axis]! < 0);
    const [column, row] = [x, y].map((place) => Math.floor((place + 1) / cell));
    cells[i] = (face * width + row!) * width + column!;
  }
  return { cells, ranges };
}
