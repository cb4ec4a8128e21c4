export { type ChosenColumns, type CloudData, readCloud, type ReadOptions, type Station } from "./files/read-cloud.js";
export type { Crs, Unit } from "./formats/las/crs.js";
export type { LazPerf } from "./formats/las/laz-perf.js";
export type { Values } from "./formats/numbers.js";
export { HprError, type HprErrorCode } from "./base/errors.js";
