export { HprError, type HprErrorCode } from "./base/errors.js";
export { HiddenPointNodesFilter } from "./nodes/filter.js";
export type { HiddenPointNodesFilterEvents } from "./nodes/gathered-filter.js";
export type { HiddenPointNodesFilterOptions } from "./nodes/options.js";
export type { Inversion } from "./query/view-options.js";
export type { AnswerKind } from "./follow/refinement.js";
export type { FollowOptions } from "./query/follow-options.js";
