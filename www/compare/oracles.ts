import { download } from "../loaders/download.ts";
import { readFaces } from "../loaders/faces.ts";
import { makeRings, skinOfRings } from "../samples/rings.ts";
import { scanRoom, type Surface } from "../samples/living-room.ts";
import type { KnownSurface } from "../samples/samples.ts";
import { streetTruth } from "../samples/street.ts";
import type { Vector } from "../samples/trace.ts";
import { grid, joined } from "./mesh.ts";
import { meshOracle, type Oracle } from "./tracer.ts";

/** The truth about a cloud whose surface is known; what is asked and answered is in the coordinates of `positions`. */
export async function oracleFor(surface: KnownSurface, positions: Float32Array): Promise<Oracle> {
  if ("faces" in surface) return meshOracle({ positions, triangles: await facesAt(surface.faces) });
  if ("file" in surface) {
    const name = "Its file";
    const blob = typeof surface.file === "string" ? await download(name, surface.file, () => undefined) : surface.file;
    return meshOracle({
      positions,
      triangles: await readFaces({ name, blob, limit: Infinity, onProgress: () => undefined }, positions.length / 3),
    });
  }
  return { rings, room, street }[surface.shape]();
}

/** Three indices of vertices a face, little-endian and packed. */
async function facesAt(url: string): Promise<Uint32Array> {
  const packed = await download("The surface", url, () => undefined);
  return new Uint32Array(
    await new Response(packed.stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer(),
  );
}

function rings(): Oracle {
  return meshOracle({ positions: makeRings().positions as Float32Array, triangles: skinOfRings() });
}

/** Of flat pieces, and each point on one of these: where its surface is, not where the noise has put it. */
function room(): Oracle {
  const { surfaces, places } = scanRoom();
  const mesh = joined(surfaces.map((surface) => grid(...surface.pieces, (u, v) => surface.at(u, v).point)));
  const firstFace = new Map<Surface, number>();
  let faces = 0;
  for (const surface of surfaces) {
    firstFace.set(surface, faces);
    faces += 2 * surface.pieces[0] * surface.pieces[1];
  }
  const on = { positions: [] as number[], faces: [] as number[] };
  for (const { surface, u, v } of places) {
    const { place, face } = onPieces(surface, u, v);
    on.positions.push(...place);
    on.faces.push(firstFace.get(surface)! + face);
  }
  return meshOracle(mesh, { positions: Float32Array.from(on.positions), faces: Uint32Array.from(on.faces) });
}

/** The point of the flat pieces that stands for one of the surface, and which triangle of `grid` it is in. */
function onPieces(surface: Surface, u: number, v: number): { place: Vector; face: number } {
  const [columns, rows] = surface.pieces;
  const [column, row] = [Math.floor(u * columns), Math.floor(v * rows)];
  const [across, up] = [u * columns - column, v * rows - row];
  const corner = (right: number, above: number) => surface.at((column + right) / columns, (row + above) / rows).point;
  const lower = across + up <= 1;
  const [from, a, b] = lower ? [corner(0, 0), corner(1, 0), corner(0, 1)] : [corner(1, 1), corner(0, 1), corner(1, 0)];
  const [alongA, alongB] = lower ? [across, up] : [1 - across, 1 - up];
  const place = from.map((value, axis) => value + alongA * (a[axis]! - value) + alongB * (b[axis]! - value)) as Vector;
  return { place, face: 2 * (row * columns + column) + (lower ? 0 : 1) };
}

/** So much of the way to a point may be wrong by rounding. */
const ROUNDING = 1e-9;

/** The scanner's own scene, asked along the rays from the viewpoint. */
function street(): Oracle {
  const { scene, places } = streetTruth();
  return {
    count: places.length / 3,
    from: (viewpoint) => (point) => {
      const way = [0, 1, 2].map((axis) => places[3 * point + axis]! - viewpoint[axis]!);
      const distance = Math.hypot(...way);
      const along = way.map((value) => value / distance) as Vector;
      return distance === 0 || scene(viewpoint as Vector, along, distance * (1 - ROUNDING)) === null;
    },
  };
}
