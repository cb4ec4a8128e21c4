import type { Points } from "three";

import { describe, HprError } from "../base/errors.js";
import { type FilterSettings, type HiddenPointFilterOptions, readFilterOptions } from "../three/options.js";

/** Those of a `HiddenPointFilter`, for all nodes as one cloud, and which nodes there are. */
export interface HiddenPointNodesFilterOptions extends HiddenPointFilterOptions {
  /** Which nodes there are now. Default: every `Points` below the root that is visible. */
  nodes?: (() => Iterable<Points>) | undefined;
}

export interface NodesSettings extends FilterSettings {
  nodes: (() => Iterable<Points>) | undefined;
}

export function readNodesOptions(options: HiddenPointNodesFilterOptions | undefined): NodesSettings {
  const { nodes, ...others } = options ?? {};
  if (nodes !== undefined && typeof nodes !== "function") {
    throw new HprError("option", `nodes must be a function that tells the nodes, got ${describe(nodes)}`);
  }
  const settings = readFilterOptions(options === undefined || typeof options === "object" ? others : options);
  return { ...settings, nodes };
}
