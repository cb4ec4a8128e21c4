import type { Object3D, Points } from "three";

import { describe, HprError } from "../base/errors.js";
import { requireUniformScale } from "../three/cameras.js";
import { patchMaterial, type PatchMaterial } from "../three/map-material.js";
import { type HiddenPointFilterOptions, oneOf } from "../three/options.js";
import { GatheredFilter } from "./gathered.js";
import type { CloudNode } from "./node-set.js";
import { NodeSet } from "./node-set.js";

/** The options of a `HiddenPointFilter` for the cloud of all nodes, and a function that chooses the nodes. */
export type HiddenPointNodesFilterOptions = HiddenPointFilterOptions & {
  cloud?: undefined;
  /** Returns the present nodes. Default: every visible `Points` below the root. */
  nodes?: (() => Iterable<Points>) | undefined;
  /**
   * How a node is drawn until its first answer: all of its points (`"draw"`, the default), or none
   * (`"hide"`, by its layers). Refused nodes are drawn.
   */
  pending?: "draw" | "hide" | undefined;
};

/**
 * Takes many `THREE.Points` as one cloud, and draws only the points that the camera sees. This is
 * for tiled viewers, such as potree-core (octrees) and 3d-tiles-renderer (point tiles). Nodes may
 * come and go, may be children of other nodes, and may have their own offsets.
 *
 * The picture is the same, to the bit, as for one cloud that was never split. New nodes are
 * appended to the cloud, and nodes that are gone are removed.
 *
 * ```js
 * const filter = new HiddenPointNodesFilter(octree); // or tiles.group
 * renderer.setAnimationLoop(() => {
 *   viewer.update(camera); // chooses the nodes
 *   filter.update(camera);
 *   renderer.render(scene, camera);
 * });
 * ```
 *
 * Nodes may move with the root freely. If they move within the root, they are read again. The
 * options mean the same as in a `HiddenPointFilter`, but for the cloud of all nodes. Orthographic
 * cameras and several cameras are handled as in that filter, too.
 */
export class HiddenPointNodesFilter extends GatheredFilter<CloudNode> {
  /** @internal */
  protected override readonly drawing: NodeSet;

  /**
   * Hides the points of all nodes that the camera of `update` does not see.
   *
   * @param root an object above all nodes. The nodes are one cloud in the space of this object, and
   *   a radius is in the units of this space.
   * @throws HprError `option`.
   */
  constructor(root: Object3D, options?: HiddenPointNodesFilterOptions) {
    if (typeof (root as unknown) !== "object" || (root as unknown) === null || !("isObject3D" in root)) {
      throw new HprError("option", `root must be a THREE.Object3D, got ${describe(root)}`);
    }
    super(root, options, ["nodes", "pending"]);
    const given = this.settings.given as HiddenPointNodesFilterOptions & Record<string, unknown>;
    const { nodes } = given;
    if (nodes !== undefined && typeof nodes !== "function") {
      throw new HprError("option", `nodes must be a function that returns the nodes, got ${describe(nodes)}`);
    }
    const hidesPending = oneOf(given, "pending", ["draw", "hide"]) === "hide";
    requireUniformScale(root);
    this.settings.patch = this.patch;
    this.drawing = new NodeSet(root, Object.assign(this.settings, { nodes, hidesPending }), this.refuseNode);
  }

  /** How materials are made to leave out hidden points. @internal */
  protected get patch(): PatchMaterial {
    return patchMaterial;
  }

  /** The indices of each node's points that are drawn, without the dimmed ones: copies. */
  get visible(): Map<Points, Uint32Array> {
    return this.drawing.drawn;
  }
}
