export { HprError, type HprErrorCode } from "./base/errors.js";
export { PotreeFilter, type PotreeFilterOptions } from "./potree/filter.js";
export type { PotreeViewer } from "./potree/viewer.js";
export type { HiddenPointNodesFilterEvents } from "./nodes/gathered.js";
export type { AskedOptions } from "./three/options.js";
export type { Inversion, RadiusRule, VisibilityOptions } from "./query/view-options.js";
export type { AnswerKind, FollowedOptions, FollowOptions } from "./follow/options.js";
