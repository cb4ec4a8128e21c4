import { BufferAttribute, BufferGeometry, DoubleSide, Ray, Vector3 } from "three";
import { MeshBVH } from "three-mesh-bvh";
import type { OnFaces } from "../samples/generator.ts";
import type { Mesh } from "../samples/mesh.ts";

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
