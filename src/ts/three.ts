export { HprError, type HprErrorCode } from "./base/errors.js";
export { HiddenPointFilter, type HiddenPointFilterEvents } from "./three/filter.js";
export type { FilterChange } from "./three/camera-filter.js";
export type { AskedOptions, HiddenPointFilterOptions } from "./three/options.js";
export type { Inversion, RadiusRule, VisibilityOptions } from "./query/view-options.js";
export type { AnswerKind, FollowedOptions, FollowOptions } from "./follow/options.js";
