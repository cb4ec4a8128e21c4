// The usual way to hide points in a picture: a z-buffer of splats. It is here to be compared with.
import type { Point } from "../bench/measure.js";

/** A splat is a square of this half-width, in spacings of the cloud. */
const SPLAT = 0.5;
/** A splat hides points that are at least this far behind it, in spacings. */
const TOLERANCE = 4;
/** The largest width of a face, in pixels. */
const WIDEST = 1024;

/**
 * Which points a z-buffer shows: 1 visible, 0 hidden. The picture is the six faces of a cube around the viewpoint, so that
 * it also works inside a cloud. A pixel is about half a spacing wide at the median distance.
 */
export function zBuffered(positions: Float32Array | Float64Array, viewpoint: Point, spacing: number): Uint8Array {
  const count = positions.length / 3;
  const distances = Float64Array.from({ length: count }, (_, i) =>
    Math.hypot(...viewpoint.map((x, axis) => positions[3 * i + axis]! - x)),
  );
  const middle = distances.slice().sort()[count >> 1]!;
  const width = Math.min(WIDEST, Math.ceil((4 * middle) / spacing));
  const nearest = Array.from({ length: 6 }, () => new Float32Array(width * width).fill(Infinity));
  for (let i = 0; i < count; i++) {
    const half = Math.max((SPLAT * spacing) / distances[i]!, 1 / width);
    for (let face = 0; face < 6; face++) {
      const place = placeOn(face, positions, viewpoint, i);
      if (place === undefined) continue;
      const [left, right] = pixels(place[0], half, width);
      const [bottom, top] = pixels(place[1], half, width);
      const depths = nearest[face]!;
      for (let y = bottom; y <= top; y++) {
        for (let x = left; x <= right; x++) {
          if (distances[i]! < depths[y * width + x]!) depths[y * width + x] = distances[i]!;
        }
      }
    }
  }
  return Uint8Array.from({ length: count }, (_, i) => {
    for (let face = 0; face < 6; face++) {
      const place = placeOn(face, positions, viewpoint, i);
      if (place === undefined || Math.max(...place.map(Math.abs)) > 1) continue;
      const [x] = pixels(place[0], 0, width);
      const [y] = pixels(place[1], 0, width);
      return Number(distances[i]! <= nearest[face]![y * width + x]! + TOLERANCE * spacing);
    }
    return 1;
  });
}

/** Where a point is on a face of the cube, from −1 to 1 if its center is on this face; undefined if it is behind the face. */
function placeOn(
  face: number,
  positions: Float32Array | Float64Array,
  viewpoint: Point,
  index: number,
): [number, number] | undefined {
  const axis = face >> 1;
  const along = (axis: number) => positions[3 * index + axis]! - viewpoint[axis]!;
  const depth = face & 1 ? -along(axis) : along(axis);
  return depth > 0 ? [along((axis + 1) % 3) / depth, along((axis + 2) % 3) / depth] : undefined;
}

/** The first and the last pixel of a splat. The first one is behind the last one if no pixel of it is on the face. */
function pixels(middle: number, half: number, width: number): [number, number] {
  const pixel = (place: number) => Math.floor(((place + 1) / 2) * width);
  return [Math.max(pixel(middle - half), 0), Math.min(pixel(middle + half), width - 1)];
}
