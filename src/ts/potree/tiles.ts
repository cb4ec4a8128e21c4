import type { Points } from "three";

import { requirePositions, readPositions, versionOf } from "../three/attribute.js";
import type { GatheredNode } from "../nodes/gathered.js";
import type { OctreeNode } from "./viewer.js";

/** A node of an octree, and its place in the world. */
export class Tile implements GatheredNode {
  readonly points: Points;
  /** The last frame in which it was drawn. */
  seen = -1;
  revision = 1;
  readonly #node: OctreeNode;
  #geometry: unknown;
  #version = -1;
  /** The matrix to the world, as it was in the last frame. */
  #matrix: number[] = [];

  constructor(node: OctreeNode, points: Points) {
    this.points = points;
    this.#node = node;
    this.noticeChange();
  }

  /** The matrix from the node's own space to the world. */
  get matrix(): readonly number[] {
    return this.#matrix;
  }

  get count(): number {
    return this.#node.geometryNode.geometry?.attributes["position"]?.count ?? 0;
  }

  /** Whether it has moved, or has other points, since the last call. */
  noticeChange(): boolean {
    const { geometry } = this.#node.geometryNode;
    const { elements } = this.points.matrixWorld;
    const position = geometry?.attributes["position"];
    const version = position === undefined ? 0 : versionOf(position);
    const isSame =
      this.#geometry === geometry && this.#version === version && this.#matrix.every((x, i) => x === elements[i]);
    if (isSame) return false;
    this.#geometry = geometry;
    this.#version = version;
    this.#matrix = [...elements];
    this.revision += 1;
    return true;
  }

  read(): Float32Array | Float64Array {
    const position = requirePositions(this.#node.geometryNode.geometry?.attributes["position"]);
    return readPositions(position, undefined, this.#matrix).numbers;
  }
}
