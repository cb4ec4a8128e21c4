import { describe, HprError } from "../base/errors.js";
import { type Camera, type CameraNumbers, isCamera, readCamera } from "./camera.js";
import { readViewpoint, type Viewpoint } from "./positions.js";
import { requireSpace } from "./view-options.js";

/** From where a cloud is seen: by an eye that looks everywhere, or by a camera, which sees only what is in its image. */
export type Seat = number[] | CameraNumbers;

/** A viewpoint, or a camera in its place. */
export type ViewpointOrCamera = Viewpoint | Camera;

/** Several viewpoints, or cameras in their place. An error says which one it is about. */
export function readSeats(list: unknown, dimension: number, name: string): Seat[] {
  if (!Array.isArray(list)) {
    throw new HprError("viewpoint", `${name} must be an array of ${dimension} numbers each, got ${describe(list)}`);
  }
  return Array.from(list, (given: unknown, i) => {
    if (!isCamera(given)) return readViewpoint(given, dimension, `viewpoint ${name}[${i}]`);
    requireSpace("a camera", dimension);
    return readCamera(given, `camera ${name}[${i}]`);
  });
}

/** Several cameras, for a question that needs their images. */
export function readCameras(list: unknown, dimension: number, method: string): CameraNumbers[] {
  requireSpace(method, dimension);
  if (!Array.isArray(list)) {
    throw new HprError("viewpoint", `cameras must be an array of cameras, got ${describe(list)}`);
  }
  return Array.from(list, (given: unknown, i) => readCamera(given, `camera cameras[${i}]`));
}

export function isCameraSeat(seat: Seat): seat is CameraNumbers {
  return seat instanceof Float64Array;
}
