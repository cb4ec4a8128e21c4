import { type ImageCamera, type CameraNumbers, isCamera, readCamera } from "./camera.js";
import { readEach, readViewpoint, type Viewpoint } from "./positions.js";
import { requireSpace } from "./options.js";

/** From where a cloud is seen: by an eye that looks everywhere, or by a camera, which sees only what is in its image. */
export type Seat = number[] | CameraNumbers;

/** A viewpoint, or a camera in its place. */
export type ViewpointOrCamera = Viewpoint | ImageCamera;

/** Several viewpoints, or cameras in their place. An error says which one it is about. */
export function readSeats(list: unknown, dimension: number, name: string): Seat[] {
  return readEach(list, name, `${dimension} numbers each`, (given, which) => {
    if (!isCamera(given)) return readViewpoint(given, dimension, `viewpoint ${which}`);
    requireSpace("a camera", dimension);
    return readCamera(given, `camera ${which}`);
  });
}

/** Several cameras, for a question that needs their images. */
export function readCameras(list: unknown): CameraNumbers[] {
  return readEach(list, "cameras", "cameras", (given, which) => readCamera(given, `camera ${which}`));
}

export function isCameraSeat(seat: Seat): seat is CameraNumbers {
  return seat instanceof Float64Array;
}
