import { Matrix4, Vector3 } from "three";
import type { Viewpoint } from "../settings/settings.ts";
import { clipping } from "../view/stage.ts";
import { inLocal } from "../view/framing.ts";
import type { Viewer } from "../view/viewer.ts";
import type { Picture } from "./zbuffer.ts";

/** The picture on screen, but from exactly this viewpoint. The camera may have moved since the question. */
export function pictureFrom(viewer: Viewer, viewpoint: Viewpoint): Picture {
  const { cloud } = viewer.scene;
  const { camera, resolution } = viewer.stage;
  const at = inLocal(cloud, viewpoint);
  const toEye = new Matrix4().compose(at, viewer.direction, new Vector3(1, 1, 1)).invert();
  return {
    matrix: new Matrix4().multiplyMatrices(camera.projectionMatrix, toEye).toArray(),
    width: resolution.x,
    height: resolution.y,
    near: clipping(at.length(), cloud.radius).near,
    pixels: (camera.projectionMatrix.elements[5] * resolution.y) / 2,
  };
}
