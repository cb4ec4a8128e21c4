export { HprError, type HprErrorCode } from "./base/errors.js";
export { HiddenPointNodesFilter, type HiddenPointNodesFilterOptions } from "./nodes/filter.js";
export type { HiddenPointNodesFilterEvents } from "./nodes/gathered.js";
export type { AskedOptions } from "./three/options.js";
export type { Inversion, VisibilityOptions } from "./query/view-options.js";
export type { AnswerKind, FollowedOptions, FollowOptions } from "./follow/options.js";
