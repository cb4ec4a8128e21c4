import type { Camera, Material, Object3D, Points } from "three";

import { describe, HprError } from "../base/errors.js";
import type { GatheredNode } from "../nodes/gathered.js";
import { readPositions, requirePositions, versionOf } from "../three/attribute.js";

/** What is used of a `Potree.Viewer`. */
export interface PotreeViewer {
  /** Its clouds and its camera. */
  readonly scene: {
    readonly pointclouds: readonly object[];
    /** The camera of the picture. */
    getActiveCamera(): Camera;
  };
  /** The renderer of its clouds. */
  readonly pRenderer: object;
  /** Calls the listener in every frame. */
  addEventListener(type: "update", listener: () => void): void;
  /** Calls it no more. */
  removeEventListener(type: "update", listener: () => void): void;
}

export interface Octree extends Object3D {
  readonly material: PotreeMaterial;
  readonly visibleNodes: readonly OctreeNode[];
}

export interface OctreeNode {
  readonly sceneNode: Points | null;
  readonly geometryNode: { readonly geometry?: Points["geometry"] };
}

type PotreeMaterial = Material & { vertexShader: string };

/** One compiled program. */
export interface PotreeShader {
  readonly uniformLocations: Readonly<Record<string, WebGLUniformLocation | undefined>>;
  setUniform1f(name: string, value: number): void;
}

/** Draws clouds by calls of its own, also for picking. It heeds no index, and no `onBeforeCompile`. */
export interface PotreeRenderer {
  readonly gl: WebGLRenderingContext | WebGL2RenderingContext;
  renderOctree(
    octree: Octree,
    nodes: readonly OctreeNode[],
    camera: Camera,
    target: unknown,
    params?: { material?: PotreeMaterial },
  ): void;
  renderNodes(
    octree: Octree,
    nodes: readonly OctreeNode[],
    data: unknown,
    camera: Camera,
    target: unknown,
    shader: PotreeShader,
    params: unknown,
  ): void;
}

export function requireViewer(viewer: unknown): asserts viewer is PotreeViewer {
  const { pRenderer, scene } = (viewer ?? {}) as { pRenderer?: Partial<PotreeRenderer>; scene?: unknown };
  if (
    typeof pRenderer?.renderOctree !== "function" ||
    typeof pRenderer.renderNodes !== "function" ||
    scene === undefined
  ) {
    throw new HprError("option", `viewer must be a Potree.Viewer of Potree 1.7 or 1.8, got ${describe(viewer)}`);
  }
}

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
