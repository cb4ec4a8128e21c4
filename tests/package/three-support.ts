import type * as Three from "three";
import { vi } from "vitest";

export type THREE = typeof Three;

/** The three.js that the package is developed with, and the oldest one that it supports. */
export const VERSIONS: [name: string, load: () => Promise<THREE>][] = [
  ["three", () => import("three")],
  ["three-oldest", () => import("three-oldest")],
];

/** Loads the package together with this three.js, as a fresh page does. */
export async function adapterFor(load: () => Promise<THREE>) {
  vi.resetModules();
  vi.doMock("three", load);
  const package_ = { ...(await import("hidden-point-removal")), ...(await import("hidden-point-removal/three")) };
  return { THREE: await load(), ...package_ };
}

export type Adapter = Awaited<ReturnType<typeof adapterFor>>;
export type Filter = InstanceType<Adapter["HiddenPointFilter"]>;

/** Points and a camera in a scene, the camera 5 away from the origin. */
export function sceneOf({ THREE }: Adapter, positions: Float32Array) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  const points = new THREE.Points(geometry, new THREE.PointsMaterial({ size: 0.02 }));
  const camera = new THREE.PerspectiveCamera();
  camera.position.set(0, 0, 5);
  const scene = new THREE.Scene();
  scene.add(points, camera);
  return { geometry, points, camera, scene };
}

export type Scene = ReturnType<typeof sceneOf>;

/** The indices of the points that a geometry draws, in order. */
export function drawn({ index, drawRange, attributes }: Three.BufferGeometry): number[] {
  const start = Math.max(0, drawRange.start);
  const end = Math.min(index?.count ?? attributes["position"]!.count, drawRange.start + drawRange.count);
  return Array.from({ length: end - start }, (_, i) => index?.getX(start + i) ?? start + i);
}
