export { HprError, type HprErrorCode } from "./base/errors.js";
export type { ResolvedInversion } from "./query/view-options.js";
export type { LazPerf } from "./formats/laz-perf.js";
export { OctreeStep } from "./stream/look.js";
export { type Octree, openOctree } from "./stream/octree.js";
export type { OctreeOptions, OctreeProgress, OctreeViewOptions } from "./stream/options.js";
export type { Fetch, PotreeFiles, RangeReader } from "./stream/source.js";
export type { VisibleNode } from "./stream/survivors.js";
export type { Box, Triple } from "./stream/tree.js";
