export { hiddenPointRemoval, PointCloud } from "./cloud.js";
export { HprError, type HprErrorCode } from "./errors.js";
export { init, type InitInput, initSync, type SyncInitInput, type WasmModule } from "./loader.js";
export { type MergeOptions, mergeVisible, type VisiblePart } from "./merge.js";
export type { PointCloudOptions, VisibilityOptions } from "./options.js";
export type { Positions } from "./positions.js";
export type { ChosenRadius, Visibility } from "./visibility.js";
