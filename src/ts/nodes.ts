export { HprError, type HprErrorCode } from "./errors.js";
export { HiddenPointNodesFilter, type HiddenPointNodesFilterEvents } from "./nodes/filter.js";
export type { HiddenPointNodesFilterOptions } from "./nodes/options.js";
export type { Inversion } from "./view-options.js";
