export { VisiblePointCloudLayer, type VisiblePointCloudLayerProps } from "./deck/layer.js";
export { HprError, type HprErrorCode } from "./errors.js";
export type { Inversion, RadiusRule, VisibilityOptions } from "./view-options.js";
