export { VisiblePointCloudLayer, type VisiblePointCloudLayerProps } from "./deck/layer.js";
export { HprError, type HprErrorCode } from "./base/errors.js";
export type { Inversion, RadiusRule, VisibilityOptions } from "./query/view-options.js";
