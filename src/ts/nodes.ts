export { HprError, type HprErrorCode } from "./base/errors.js";
export { HiddenPointNodesFilter, type HiddenPointNodesFilterOptions } from "./nodes/filter.js";
export type { HiddenPointNodesFilterEvents } from "./nodes/gathered.js";
export type { Inversion } from "./query/view-options.js";
export type { AnswerKind, FollowOptions } from "./follow/options.js";
