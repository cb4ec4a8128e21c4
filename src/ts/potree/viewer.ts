import type { Camera, Material, Object3D, Points } from "three";

import { describe, HprError } from "../base/errors.js";

/** What is used of Potree 1.8: its `Viewer`. */
export interface PotreeViewer {
  readonly scene: {
    readonly pointclouds: readonly Octree[];
    getActiveCamera(): Camera;
  };
  readonly pRenderer: PotreeRenderer;
  addEventListener(type: "update", listener: () => void): void;
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
  const { pRenderer, scene } = (viewer ?? {}) as Partial<PotreeViewer>;
  if (typeof pRenderer?.renderOctree !== "function" || typeof pRenderer.renderNodes !== "function" || !scene) {
    throw new HprError("option", `viewer must be a Potree.Viewer of Potree 1.7 or 1.8, got ${describe(viewer)}`);
  }
}
