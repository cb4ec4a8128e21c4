export { type ChosenColumns, type CloudData, readCloud, type ReadOptions, type Station } from "./files/read-cloud.js";
export { type CameraOfImage, type FileSource, type ImageSize, readCameras } from "./files/read-cameras.js";
export { writeCloud, type WritableCloud, type WriteOptions } from "./files/write-cloud.js";
export type { WrittenFormat } from "./formats/write/content.js";
export { colmapVis } from "./files/cameras/colmap.js";
export type { Crs, Unit } from "./formats/las/crs.js";
export type { Values } from "./formats/numbers.js";
export { HprError, type HprErrorCode } from "./base/errors.js";
export type { ImageCamera, CameraModel, Intrinsics, Pose } from "./query/camera.js";
