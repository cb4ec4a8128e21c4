import type { Matrix4, Object3D } from "three";

/**
 * Writes the matrix from an object's space to that of an object above it. It is not computed through world
 * coordinates: their rounding would separate points that are equal in two nodes.
 */
export function placeIn(root: Object3D, object: Object3D, place: Matrix4): Matrix4 {
  if (object === root) return place.identity();
  const holder = holderOf(root, object);
  if (object.matrixAutoUpdate) object.updateMatrix();
  return holder === null ? place.copy(object.matrix) : placeIn(root, holder, place).multiply(object.matrix);
}

/**
 * The object that the matrix of `object` is relative to. In the octrees of potree-core, nodes are children of nodes, but each
 * node is drawn relative to the octree.
 */
function holderOf(root: Object3D, object: Object3D): Object3D | null {
  for (let at = object.parent; at !== null && at !== root; at = at.parent) {
    if ("pcoGeometry" in at) return at;
  }
  return object.parent === null || "pcoGeometry" in root ? null : object.parent;
}
