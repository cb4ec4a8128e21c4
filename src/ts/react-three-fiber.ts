export { HprError, type HprErrorCode } from "./base/errors.js";
export { useHiddenPointFilter, type UseHiddenPointFilterOptions } from "./react-three-fiber/use-hidden-point-filter.js";
export { VisiblePoints, type VisiblePointsProps } from "./react-three-fiber/visible-points.js";
export type { HiddenPointFilter } from "./three/filter.js";
export type { HiddenPointFilterOptions } from "./three/options.js";
export type { Inversion, RadiusRule, VisibilityOptions } from "./query/view-options.js";
export type { AnswerKind, FollowOptions } from "./follow/options.js";
