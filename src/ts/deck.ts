export { VisiblePointCloudLayer, type VisibleAnswer, type VisiblePointCloudLayerProps } from "./deck/layer.js";
export { HprError, type HprErrorCode } from "./base/errors.js";
export type { Inversion, RadiusRule, VisibilityOptions } from "./query/view-options.js";
export type { AnswerKind, FollowedOptions, FollowOptions } from "./follow/options.js";
