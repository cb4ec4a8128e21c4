// What every entry has in common: all but where the wasm comes from.
export type { ChosenRadius } from "./answers.js";
export { hiddenPointRemoval, PointCloud } from "./cloud.js";
export type { InitInput, SyncInitInput, WasmModule } from "./compile.js";
export { HprError, type HprErrorCode } from "./errors.js";
export { permissibleCurvature, radiusBound, type RingOptions, ringOfViewpoints, simdEnabled } from "./formulas.js";
export { type MergeOptions, mergeVisible, type VisiblePart } from "./merge.js";
export type { PointCloudOptions } from "./options.js";
export type { Positions } from "./positions.js";
export type { IlluminationOptions, ReconstructionOptions } from "./queries.js";
export type { Inversion, RadiusRule, ResolvedInversion, VisibilityOptions } from "./view-options.js";
export { initSync } from "./start.js";
export type { Reconstruction, Visibility } from "./visibility.js";
