import type { Viewpoint } from "../settings/settings.ts";
import type { Viewer } from "./viewer.ts";
import { inLocal } from "./framing.ts";

/** Finds a place in the picture, in CSS pixels from its left and top. `null`: it is behind the camera. */
export function project({ scene, stage }: Viewer, place: Viewpoint): { x: number; y: number } | null {
  const { camera, size } = stage;
  const seen = inLocal(scene.cloud, place).applyMatrix4(camera.matrixWorldInverse);
  if (seen.z >= 0) return null;
  const { x, y } = seen.applyMatrix4(camera.projectionMatrix);
  return { x: (0.5 + x / 2) * size.width, y: (0.5 - y / 2) * size.height };
}
