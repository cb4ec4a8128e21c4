// The true visibility of a mesh. A point is visible if the segment from it to the viewpoint
// meets no other face. A point's own faces are left out, because they touch only the segment's end.
import { BufferAttribute, BufferGeometry, DoubleSide, Ray, Vector3 } from "three";
import { PLYLoader } from "three/addons/loaders/PLYLoader.js";
import { MeshBVH } from "three-mesh-bvh";
import type { Mesh } from "../../www/samples/generator.js";
import { dragonPly } from "../bench/clouds.js";
import type { Point } from "../bench/measure.js";

/** Points of a mesh, and the face of each point. Without faces, the points are the mesh's vertices. */
export interface MeshPoints {
  positions: Float32Array | Float64Array;
  faces?: Uint32Array;
}

export class RayTracer {
  readonly #mesh: Mesh;
  readonly #tree: MeshBVH;

  constructor(mesh: Mesh) {
    this.#mesh = mesh;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(mesh.positions, 3));
    geometry.setIndex(new BufferAttribute(mesh.triangles, 1));
    // Indirect: the triangles keep their order, and so their numbers.
    this.#tree = new MeshBVH(geometry, { indirect: true });
  }

  /** One byte for each point: 1 if it sees `target`. */
  visibleFrom(target: Point, points: MeshPoints = this.#mesh): Uint8Array {
    const [end, ray] = [new Vector3(...target), new Ray()];
    return Uint8Array.from({ length: points.positions.length / 3 }, (_, i) => {
      ray.origin.fromArray(points.positions, 3 * i);
      ray.direction.subVectors(end, ray.origin);
      const distance = ray.direction.length();
      ray.direction.divideScalar(distance);
      const hits = this.#tree.raycast(ray, DoubleSide, 0, distance);
      return hits.every(({ faceIndex }) => this.#isOwn(faceIndex!, i, points)) ? 1 : 0;
    });
  }

  #isOwn(face: number, point: number, { faces }: MeshPoints): boolean {
    return faces === undefined
      ? this.#mesh.triangles.subarray(3 * face, 3 * face + 3).includes(point)
      : faces[point] === face;
  }
}

/** The Stanford dragon with its faces, in the order of its file. */
export function dragonMesh(name: Parameters<typeof dragonPly>[0]): Mesh {
  const geometry = new PLYLoader().parse(dragonPly(name));
  return {
    positions: geometry.getAttribute("position").array as Float32Array,
    triangles: Uint32Array.from(geometry.getIndex()!.array),
  };
}
