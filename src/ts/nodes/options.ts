import type { Points } from "three";

import { describe, HprError } from "../base/errors.js";
import { type FilterSettings, type HiddenPointFilterOptions, readFilterOptions } from "../three/options.js";

/** The options of a `HiddenPointFilter` for the cloud of all nodes, and a function that chooses the nodes. */
export interface HiddenPointNodesFilterOptions extends HiddenPointFilterOptions {
  /** Returns the present nodes. Default: every visible `Points` below the root. */
  nodes?: (() => Iterable<Points>) | undefined;
  /**
   * How a node is drawn until its first answer: all of its points (`"draw"`, the default), or none
   * (`"hide"`, by its layers). Refused nodes are drawn.
   */
  pending?: "draw" | "hide" | undefined;
}

export interface NodesSettings extends FilterSettings {
  hidesPending: boolean;
  nodes: (() => Iterable<Points>) | undefined;
}

export function readNodesOptions(options: HiddenPointNodesFilterOptions | undefined): NodesSettings {
  const { nodes, pending = "draw", ...others } = options ?? {};
  if (nodes !== undefined && typeof nodes !== "function") {
    throw new HprError("option", `nodes must be a function that returns the nodes, got ${describe(nodes)}`);
  }
  if ((pending as unknown) !== "draw" && (pending as unknown) !== "hide") {
    throw new HprError("option", `pending must be "draw" or "hide", got ${describe(pending)}`);
  }
  const settings = readFilterOptions(options === undefined || typeof options === "object" ? others : options);
  return { ...settings, nodes, hidesPending: pending === "hide" };
}
