import { Matrix4, PerspectiveCamera, Vector3 } from "three";
import type { Cloud } from "../cloud/cloud.ts";
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

/** The width of each side in pixels. */
const SIDE = 1024;
const SIDES = [
  [1, 0, 0],
  [-1, 0, 0],
  [0, 1, 0],
  [0, -1, 0],
  [0, 0, 1],
  [0, 0, -1],
] as const;

/** Six pictures of all that is around a viewpoint: the sides of a cube. */
export function picturesAround(cloud: Cloud, viewpoint: Viewpoint): Picture[] {
  const at = inLocal(cloud, viewpoint);
  const { near, far } = clipping(at.length(), cloud.radius);
  const { projectionMatrix } = new PerspectiveCamera(90, 1, near, far);
  return SIDES.map((side) => {
    const up = new Vector3(...(side[1] === 0 ? [0, 1, 0] : [1, 0, 0]));
    const toEye = new Matrix4()
      .lookAt(at, new Vector3(...side).add(at), up)
      .setPosition(at)
      .invert();
    const matrix = new Matrix4().multiplyMatrices(projectionMatrix, toEye).toArray();
    return { matrix, width: SIDE, height: SIDE, near, pixels: SIDE / 2 };
  });
}
