import type { Points } from "three";

import { describe, HprError } from "../base/errors.js";
import { type FilterSettings, type HiddenPointFilterOptions, readFilterOptions } from "../three/options.js";

/** The options of a `HiddenPointFilter` for the cloud of all nodes, and a function that chooses the nodes. */
export interface HiddenPointNodesFilterOptions extends HiddenPointFilterOptions {
  /** Returns the present nodes. Default: every visible `Points` below the root. */
  nodes?: (() => Iterable<Points>) | undefined;
}

export interface NodesSettings extends FilterSettings {
  nodes: (() => Iterable<Points>) | undefined;
}

export function readNodesOptions(options: HiddenPointNodesFilterOptions | undefined): NodesSettings {
  const { nodes, ...others } = options ?? {};
  if (nodes !== undefined && typeof nodes !== "function") {
    throw new HprError("option", `nodes must be a function that returns the nodes, got ${describe(nodes)}`);
  }
  const settings = readFilterOptions(options === undefined || typeof options === "object" ? others : options);
  return { ...settings, nodes };
}
