import { HiddenPointNodesFilter as NodesFilter } from "./nodes/filter.js";
import { HiddenPointFilter as Filter } from "./three/filter.js";
import { patchNodes } from "./three/map-nodes.js";

export { HprError, type HprErrorCode } from "./base/errors.js";
export type { HiddenPointNodesFilterEvents } from "./nodes/gathered.js";
export type { HiddenPointNodesFilterOptions } from "./nodes/filter.js";
export type { HiddenPointFilterEvents } from "./three/filter.js";
export type { AskedOptions, HiddenPointFilterOptions } from "./three/options.js";
export type { Inversion, RadiusRule, VisibilityOptions } from "./query/view-options.js";
export type { AnswerKind, FollowedOptions, FollowOptions } from "./follow/options.js";

/** The filter of `hidden-point-removal/three` for a `WebGPURenderer`, with WebGPU or WebGL 2. */
export class HiddenPointFilter extends Filter {
  /** @internal */
  protected override get patch(): typeof patchNodes {
    return patchNodes;
  }
}

/** The filter of `hidden-point-removal/nodes` for a `WebGPURenderer`. */
export class HiddenPointNodesFilter extends NodesFilter {
  /** @internal */
  protected override get patch(): typeof patchNodes {
    return patchNodes;
  }
}
