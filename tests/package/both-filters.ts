// Both filters for three.js, with one scene for either: one takes the points, the other takes their group.
import { HiddenPointNodesFilter } from "hidden-point-removal/nodes";
import { HiddenPointFilter } from "hidden-point-removal/three";
import * as THREE from "three";
import { afterEach } from "vitest";

export const BOTH = [
  ["HiddenPointFilter", (points: THREE.Points, options: object) => new HiddenPointFilter(points, options)],
  [
    "HiddenPointNodesFilter",
    (points: THREE.Points, options: object) => new HiddenPointNodesFilter(points.parent!, options),
  ],
] as const;

/** They are disposed of after each test. */
export const filters: { dispose(): void }[] = [];

afterEach(() => {
  for (const filter of filters.splice(0)) filter.dispose();
});

export function cameraAt(x: number, y: number, z: number): THREE.PerspectiveCamera {
  const camera = new THREE.PerspectiveCamera();
  camera.position.set(x, y, z);
  return camera;
}

/** A cloud in a group of a scene, and a camera. */
export function pointsOf(positions: Float32Array) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  const points = new THREE.Points(geometry, new THREE.PointsMaterial());
  const group = new THREE.Group().add(points);
  const camera = cameraAt(0, 0, 5);
  new THREE.Scene().add(group, camera);
  return { geometry, points, group, camera };
}
