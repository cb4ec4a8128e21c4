export { HprError, type HprErrorCode } from "./errors.js";
export type { PointCloudOptions, VisibilityOptions } from "./options.js";
export type { Positions } from "./positions.js";
export type { ChosenRadius, Visibility } from "./visibility.js";
export {
  WorkerPointCloud,
  type WorkerPointCloudOptions,
  type WorkerVisibilityOptions,
} from "./worker/client.js";
