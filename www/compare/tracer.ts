import { BufferAttribute, BufferGeometry, DoubleSide, Ray, Vector3 } from "three";
import { MeshBVH } from "three-mesh-bvh";
import type { Mesh } from "./mesh.ts";

/** Tells whether a viewpoint sees a point of the cloud. */
export type Sight = (point: number) => boolean;

/** A surface of which it is known what can be seen of it from anywhere. */
export interface Oracle {
  /** The points of the cloud that lie on it. */
  count: number;
  from: (viewpoint: readonly number[]) => Sight;
}

/** Points on a mesh that are not its vertices, each with the face it lies on. */
export interface OnFaces {
  positions: Float32Array;
  faces: Uint32Array;
}

/**
 * A point is seen where the segment from it to the viewpoint meets no face but its own: the one that it lies on, or those
 * that it is a corner of.
 */
export function meshOracle(mesh: Mesh, on: OnFaces | null = null): Oracle {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(mesh.positions, 3));
  geometry.setIndex(new BufferAttribute(mesh.triangles, 1));
  // Indirect: the triangles keep their order, and so their numbers.
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
