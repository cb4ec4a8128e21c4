import type { Object3D, Points } from "three";

import { describe, HprError } from "../base/errors.js";
import type { Visibility } from "../cloud/visibility.js";
import type { AskedStage } from "../follow/refinement.js";
import type { Place } from "../query/place.js";
import type { VisibilityOptions } from "../query/view-options.js";
import type { FollowedCamera } from "../three/cameras.js";
import { requireUniformScale } from "../three/eye.js";
import { MapMaterial, type PatchMaterial } from "../three/map-material.js";
import { GatheredFilter } from "./gathered-filter.js";
import type { CloudNode } from "./node.js";
import { NodeHorizons } from "./node-horizons.js";
import { NodeSet } from "./node-set.js";
import { type HiddenPointNodesFilterOptions, readNodesOptions } from "./options.js";

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
  readonly #horizons: NodeHorizons;

  /**
   * @param root an object above all nodes. The nodes are one cloud in the space of this object, and
   *   a radius is in the units of this space.
   * @throws HprError `option`.
   */
  constructor(root: Object3D, options?: HiddenPointNodesFilterOptions);
  /** @internal */
  constructor(root: Object3D, options: HiddenPointNodesFilterOptions | undefined, patch?: PatchMaterial);
  constructor(root: Object3D, options?: HiddenPointNodesFilterOptions, patch: PatchMaterial = MapMaterial.of) {
    if (typeof (root as unknown) !== "object" || (root as unknown) === null || !("isObject3D" in root)) {
      throw new HprError("option", `root must be a THREE.Object3D, got ${describe(root)}`);
    }
    const settings = readNodesOptions(options, patch);
    requireUniformScale(root);
    super(root, settings);
    this.drawing = new NodeSet(root, settings, this.refuseNode);
    this.#horizons = new NodeHorizons(this.drawing, (error) => {
      this.report({ error, points: null });
      this.tell();
    });
  }

  /** The indices of each node's points that are drawn, without the dimmed ones: copies. */
  get visible(): Map<Points, Uint32Array> {
    return this.drawing.drawn;
  }

  /**
   * Whether every point in a box would be hidden from the camera of the last `update`. A tiled viewer
   * need not load such tiles. `true` is certain for the radius of the last answer, and `false` may also
   * be the answer for a hidden box. It is always `false` before the first exact answer for the present
   * viewpoint, for orthographic cameras, and with `looks`, `denoise` or `vote` as the main question.
   *
   * An automatic radius changes with the nodes, so a change of nodes makes it `false` until the next answer.
   * If `radius` or the scale of the exponential inversion is a number, it stays while nodes are added, and
   * while nodes go that have no visible point.
   *
   * The first call after an answer makes a hull of up to 50,000 visible points in this thread.
   *
   * @param min the least x, y, z in the root's space.
   * @param max the largest x, y, z.
   * @throws HprError `option` (not finite, or a minimum above its maximum), `too-large`, `internal`.
   */
  hidesBox(min: ArrayLike<number>, max: ArrayLike<number>): boolean {
    return this.#horizons.hidesBox(this.enabled ? this.cameras.last : undefined, min, max);
  }

  /** Draws everything as it was before, and frees the memory of the cloud. May be called twice. */
  override dispose(): void {
    super.dispose();
    this.#horizons.clear();
  }

  /** @internal */
  protected override left(camera: FollowedCamera): void {
    this.#horizons.drop(camera);
  }

  /** @internal */
  protected override taking(
    camera: FollowedCamera,
    place: Place,
    answer: Visibility,
    stage: AskedStage<VisibilityOptions>,
    version: number | undefined,
  ): ((node: CloudNode, own: Uint32Array) => void) | undefined {
    const horizon = this.#horizons.begin(camera, place, answer, stage, version);
    return (
      horizon &&
      ((node, own) => {
        horizon.add(node, own);
      })
    );
  }
}
