import type { Camera, Material, Object3D, Points } from "three";

import { describe, HprError } from "../base/errors.js";

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

export type PotreeMaterial = Material & { vertexShader: string };

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
