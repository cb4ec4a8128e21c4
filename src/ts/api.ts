// The exports of every entry. The entries differ only in the source of the wasm.
export { hiddenPointRemoval, PointCloud } from "./cloud/cloud.js";
export type { InitInput, SyncInitInput, WasmModule } from "./instance/compile.js";
export { type Addresses, configure } from "./instance/configure.js";
export { HprError, type HprErrorCode } from "./base/errors.js";
export { permissibleCurvature, radiusBound, type RingOptions, ringOfViewpoints } from "./cloud/formulas.js";
export { Horizon } from "./cloud/horizon.js";
export { transfer, type TransferImage, type Transferred, type TransferOptions } from "./cloud/transfer.js";
export { type MergeOptions, mergeVisible, type VisiblePart } from "./cloud/merge.js";
export type { PointCloudOptions } from "./query/options.js";
export type { Positions, Viewpoint } from "./query/positions.js";
export type { NumberArray } from "./base/typed-arrays.js";
export type {
  IlluminationOptions,
  PanoramaOptions,
  ReconstructionOptions,
  VisibilityMapOptions,
} from "./query/option-rows.js";
export type { ChosenRadius, Panorama } from "./query/queries.js";
export type { ImageCamera, CameraModel, Intrinsics, Pose } from "./query/camera.js";
export {
  cameraFromPose,
  cameraFromThree,
  intrinsicsFromFieldOfView,
  type PerspectiveCameraLike,
  type PosedCamera,
} from "./query/cameras.js";
export type { Calibration, Station } from "./query/calibration.js";
export type { ViewpointOrCamera } from "./query/camera.js";
export { orientNormals } from "./query/orient-normals.js";
export type { CoverageOptions, Placement, PlacementOptions, SeenBy } from "./query/surveys.js";
export type { Cone, SurfaceKind, Within, Without } from "./query/option-types.js";
export type { Inversion, OneWay, RadiusRule, ResolvedInversion, VisibilityOptions } from "./query/view-options.js";
export { initSync } from "./instance/init-sync.js";
export { VisibilityMap, type VisibilityMapUniforms } from "./cloud/visibility-map.js";
export type { CameraView, Reconstruction, ScoredIf, Visibility } from "./cloud/visibility.js";
