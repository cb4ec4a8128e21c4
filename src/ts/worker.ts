export type { ChosenRadius } from "./answers.js";
export { HprError, type HprErrorCode } from "./errors.js";
export type { PointCloudOptions } from "./options.js";
export type { Positions } from "./positions.js";
export type { IlluminationOptions, ReconstructionOptions } from "./queries.js";
export type { Inversion, RadiusRule, ResolvedInversion, VisibilityOptions } from "./view-options.js";
export type { Reconstruction, Visibility } from "./visibility.js";
export {
  type RequestOptions,
  WorkerPointCloud,
  type WorkerPointCloudOptions,
  type WorkerVisibilityOptions,
} from "./worker/client.js";
