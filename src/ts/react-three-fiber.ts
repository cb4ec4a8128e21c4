export { HprError, type HprErrorCode } from "./base/errors.js";
export {
  useHiddenPointFilter,
  type UseHiddenPointFilterOptions,
  VisiblePoints,
  type VisiblePointsProps,
} from "./react-three-fiber/hooks.js";
export type { HiddenPointFilter } from "./three/filter.js";
export type { AskedOptions, HiddenPointFilterOptions } from "./three/options.js";
export type { Inversion, RadiusRule, VisibilityOptions } from "./query/view-options.js";
export type { AnswerKind, FollowedOptions, FollowOptions } from "./follow/options.js";
