import { Vector3 } from "three";
import type { Viewpoint } from "../settings/settings.ts";
import type { Viewer } from "./viewer.ts";
import { inFile, inLocal } from "./framing.ts";

/** Finds a place in the picture, in CSS pixels from its left and top. `null`: it is behind the camera. */
export function project({ scene, stage }: Viewer, place: Viewpoint): { x: number; y: number } | null {
  const { camera, size } = stage;
  const seen = inLocal(scene.cloud, place).applyMatrix4(camera.matrixWorldInverse);
  if (seen.z >= 0) return null;
  const { x, y } = seen.applyMatrix4(camera.projectionMatrix);
  return { x: (0.5 + x / 2) * size.width, y: (0.5 - y / 2) * size.height };
}

/** The place behind a point of the picture, as far ahead of the camera as `like`. */
export function placeAt({ scene, stage }: Viewer, x: number, y: number, like: Viewpoint): Viewpoint {
  const { camera, size } = stage;
  const depth = -inLocal(scene.cloud, like).applyMatrix4(camera.matrixWorldInverse).z;
  const place = new Vector3((2 * x) / size.width - 1, 1 - (2 * y) / size.height, 0);
  place.applyMatrix4(camera.projectionMatrixInverse);
  place.multiplyScalar(-depth / place.z);
  return inFile(scene.cloud, place.applyMatrix4(camera.matrixWorld));
}
