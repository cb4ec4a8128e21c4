import { BufferAttribute, BufferGeometry, DoubleSide, Ray, Vector3 } from "three";
import { MeshBVH } from "three-mesh-bvh";
import type { Mesh, OnFaces, Truth } from "../samples/generator.ts";
import { download } from "../loaders/download.ts";
import { generatorOf } from "../samples/generators.ts";
import type { KnownSurface } from "../samples/samples.ts";
import type { Vector } from "../samples/trace.ts";

/** Whether a viewpoint sees a point of the cloud. */
export type Sight = (point: number) => boolean;

/** A known surface: for any viewpoint it is certain which points can be seen. */
export interface Oracle {
  /** The points of the cloud that lie on it. */
  count: number;
  from: (viewpoint: readonly number[]) => Sight;
}

/**
 * A point is seen if the segment from it to the viewpoint meets no face but the point's own: the face that it lies on,
 * or the faces that it is a corner of.
 */
export function meshOracle(mesh: Mesh, on: OnFaces | null = null): Oracle {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(mesh.positions, 3));
  geometry.setIndex(new BufferAttribute(mesh.triangles, 1));
  // Indirect: the triangles keep their order, so they keep their numbers.
  const tree = new MeshBVH(geometry, { indirect: true });
  const { triangles } = mesh;
  const positions = on ? on.positions : mesh.positions;
  const isOwn = on
    ? (face: number, point: number) => on.faces[point] === face
    : (face: number, point: number) =>
        triangles[3 * face] === point || triangles[3 * face + 1] === point || triangles[3 * face + 2] === point;

  const ray = new Ray();
  return {
    count: positions.length / 3,
    from(viewpoint) {
      const target = new Vector3().fromArray(viewpoint);
      return (point) => {
        ray.origin.fromArray(positions, 3 * point);
        ray.direction.subVectors(target, ray.origin);
        const distance = ray.direction.length();
        ray.direction.divideScalar(distance);
        return tree.raycast(ray, DoubleSide, 0, distance).every(({ faceIndex }) => isOwn(faceIndex!, point));
      };
    },
  };
}

/** The truth about a cloud whose surface is known: in the coordinates of `positions`, or in those of a sample's file. */
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
  return "mesh" in truth ? meshOracle(truth.mesh, truth.on) : sceneOracle(truth);
}

/** The end of a ray is rounded. So the ray ends before its point, by this share of its length. */
const ROUNDING = 1e-9;

/** Sends a ray from the viewpoint to each point of a scene of solids. */
function sceneOracle({ scene, places, origin = [0, 0, 0] }: Extract<Truth, { places: unknown }>): Oracle {
  return {
    count: places.length / 3,
    from: (viewpoint) => {
      const eye = origin.map((value, axis) => viewpoint[axis]! - value) as Vector;
      return (point) => {
        const way = [0, 1, 2].map((axis) => places[3 * point + axis]! - eye[axis]!);
        const distance = Math.hypot(...way);
        const along = way.map((value) => value / distance) as Vector;
        return distance === 0 || scene(eye, along, distance * (1 - ROUNDING)) === null;
      };
    },
  };
}
