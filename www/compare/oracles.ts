import { download } from "../loaders/download.ts";
import type { Truth } from "../samples/generator.ts";
import { generatorOf } from "../samples/generators.ts";
import type { KnownSurface } from "../samples/samples.ts";
import type { Solid, Vector } from "../samples/trace.ts";
import { meshOracle, type Oracle } from "./tracer.ts";

/** The truth about a cloud whose surface is known. Questions and answers are in the coordinates of `positions`. */
export async function oracleFor(surface: KnownSurface, positions: Float32Array): Promise<Oracle> {
  if ("faces" in surface) return meshOracle({ positions, triangles: await facesAt(surface.faces) });
  const { truth } = await generatorOf(surface.sample);
  return oracleOf(truth!());
}

/** Downloads the faces: three indices of vertices for each face, little-endian and packed. */
async function facesAt(url: string): Promise<Uint32Array> {
  const packed = await download("The surface", url, () => undefined);
  return new Uint32Array(
    await new Response(packed.stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer(),
  );
}

function oracleOf(truth: Truth): Oracle {
  return "mesh" in truth ? meshOracle(truth.mesh, truth.on) : sceneOracle(truth.scene, truth.places);
}

/** The end of a ray is rounded. So the ray ends before its point, by this share of its length. */
const ROUNDING = 1e-9;

/** Sends a ray from the viewpoint to each point of a scene of solids. */
function sceneOracle(scene: Solid<unknown>, places: Float64Array): Oracle {
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
