export type { ChosenRadius } from "./query/queries.js";
export { type Addresses, configure } from "./instance/configure.js";
export { HprError, type HprErrorCode } from "./base/errors.js";
export type { PointCloudOptions } from "./query/options.js";
export type { Positions } from "./query/positions.js";
export type { NumberArray } from "./base/typed-arrays.js";
export type { IlluminationOptions, ReconstructionOptions } from "./query/option-rows.js";
export type { Inversion, RadiusRule, ResolvedInversion, VisibilityOptions } from "./query/view-options.js";
export type { Reconstruction, ScoredIf, Visibility } from "./cloud/visibility.js";
export type { AnswerKind, FollowedOptions, FollowOptions } from "./follow/options.js";
export { type StreamedAnswer, ViewStream, type ViewStreamOptions } from "./worker/view-stream.js";
export {
  type RequestOptions,
  WorkerPointCloud,
  type WorkerPointCloudOptions,
  type WorkerVisibilityOptions,
} from "./worker/client.js";
