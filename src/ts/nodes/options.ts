import type { Material, Points } from "three";

import { describe, HprError } from "../errors.js";
import { type FilterSettings, readFilterOptions } from "../three/options.js";
import type { Inversion } from "../view-options.js";

/** How all nodes are seen, and how hidden points are drawn. */
export interface HiddenPointNodesFilterOptions {
  /**
   * R for all nodes together, in units of the root's space: a number, at least the distance of
   * the farthest point. Or `"auto"`, the default: chosen from the spacing of all points (of
   * a sample of 30,000 of them) when the set of nodes has settled, and kept while it is at
   * least the distance of the farthest corner of a node's box, and within a tenth of a
   * decade of what would be chosen.
   */
  radius?: number | "auto" | undefined;
  /** R = distance of the farthest corner of a node's box · 10^exponent; at least 0. */
  exponent?: number | undefined;
  /** How points are flipped; default `"spherical"`. */
  inversion?: Inversion | undefined;
  /** Which nodes there are now. Default: every `Points` below the root that is visible. */
  nodes?: (() => Iterable<Points>) | undefined;
  /** As for a `HiddenPointFilter`. */
  worker?: boolean | undefined;
  /** As for a `HiddenPointFilter`. */
  mode?: "hide" | "dim" | undefined;
  /** As for a `HiddenPointFilter`. */
  dimMaterial?: Material | undefined;
  /** As for a `HiddenPointFilter`. */
  nonFinite?: "error" | "skip" | undefined;
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
  const { radius, denoise, vote } = settings.view;
  if (radius === "search" || radius === "opposite") {
    throw new HprError("option", `radius must be a number or "auto" for nodes, got ${describe(radius)}`);
  }
  if (denoise !== undefined || vote !== undefined) {
    throw new HprError("option", "denoise and vote cannot be used with nodes: a point's neighbors may be in another");
  }
  return { ...settings, nodes };
}
