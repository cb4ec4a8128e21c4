import type { Camera, Object3D, Points } from "three";

import { describe, HprError } from "../base/errors.js";
import type { Round } from "../follow/follower.js";
import type { AnswerKind } from "../follow/refinement.js";
import type { Place } from "../query/place.js";
import { CameraFilter } from "../three/camera-filter.js";
import type { FollowedCamera } from "../three/cameras.js";
import { requireUniformScale } from "../three/eye.js";
import { Gathered } from "./gathered.js";
import type { Refused } from "./node.js";
import { NodeHorizons } from "./node-horizons.js";
import { NodeSet } from "./node-set.js";
import { type HiddenPointNodesFilterOptions, readNodesOptions } from "./options.js";

/** The events of a filter of nodes. */
export interface HiddenPointNodesFilterEvents {
  /**
   * A new answer is drawn. `count` is the number of visible points. `nodes` is the number of nodes
   * in the cloud. `answer` says what the answer is: a map or a draft comes before the exact one. For a map, `count`
   * and `radius` are those of the last answer. Either `viewpoint` or `direction` is null. `radius` is 0 if the
   * inversion has none. The viewpoint, the direction and the radius are in the root's space.
   */
  change: {
    count: number;
    nodes: number;
    milliseconds: number;
    viewpoint: number[] | null;
    direction: number[] | null;
    radius: number;
    answer: AnswerKind;
    camera: Camera;
  };
  /**
   * A node (`points`) or a view (`points` is null) is refused. For a node, this comes only once
   * until the node changes. For views, it comes only once until there is an answer again. Without a
   * listener, the error is an unhandled rejection.
   */
  error: { error: Error; points: Points | null };
}

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
export class HiddenPointNodesFilter extends CameraFilter<HiddenPointNodesFilterEvents> {
  /** @internal */
  protected override readonly drawing: NodeSet;
  readonly #gathered: Gathered;
  readonly #horizons: NodeHorizons;
  /**
   * The version of the set of nodes that the last question was about. Undefined if the question
   * must be asked again.
   */
  #askedVersion: number | undefined;
  /** Whether the cloud was lost or dropped and must be made again. */
  #isDropped = false;
  /** Whether the cloud could not be made. It is made again when a camera moves or the nodes change. */
  #isFailed = false;
  #visible = 0;
  #radius = 0;
  readonly #refuseNode: Refused = (error, points) => {
    this.report({ error, points }, false);
  };

  /**
   * @param root an object above all nodes. The nodes are one cloud in the space of this object, and
   *   a radius is in the units of this space.
   * @throws HprError `option`.
   */
  constructor(root: Object3D, options?: HiddenPointNodesFilterOptions) {
    if (typeof (root as unknown) !== "object" || (root as unknown) === null || !("isObject3D" in root)) {
      throw new HprError("option", `root must be a THREE.Object3D, got ${describe(root)}`);
    }
    const settings = readNodesOptions(options);
    requireUniformScale(root);
    super(root, settings);
    this.drawing = new NodeSet(root, settings, this.#refuseNode);
    this.#gathered = new Gathered(settings);
    this.#horizons = new NodeHorizons(this.drawing, (error) => {
      this.report({ error, points: null });
      this.tell();
    });
  }

  /** The indices of each node's points that are drawn, without the dimmed ones: copies. */
  get visible(): Map<Points, Uint32Array> {
    return this.drawing.drawn;
  }

  /** The number of visible points of all nodes, in the last answer. */
  get visibleCount(): number {
    return this.#visible;
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

  override dispose(): void {
    super.dispose();
    this.#gathered.close();
    this.#horizons.clear();
  }

  /** Whether the nodes are not those of the last question. @internal */
  protected override get isStale(): boolean {
    return this.#isChanged && !this.frozen;
  }

  /** @internal */
  protected override get isEmpty(): boolean {
    return this.#gathered.isEmpty;
  }

  /** @internal */
  protected override next(): Round | undefined {
    if (this.#isDropped) {
      this.#isDropped = false;
      this.#askedVersion = undefined;
    }
    if (!this.wantsAnswer) {
      return undefined;
    }
    return this.isStale ? this.#gathering() : this.#viewing(this.cameras.due(this.frozen)!);
  }

  /** @internal */
  protected override noticeChanges(): boolean {
    this.drawing.takeUp();
    return this.#isChanged;
  }

  /** @internal */
  protected override leave(camera: FollowedCamera): void {
    this.#horizons.drop(camera);
    if (this.#isFailed) {
      this.#isFailed = false;
      this.#askedVersion = undefined;
    }
  }

  /** @internal */
  protected override dropCloud(): void {
    this.#gathered.drop();
    this.#isDropped = true;
  }

  get #isChanged(): boolean {
    return this.#askedVersion !== this.drawing.version;
  }

  /** Updates the cloud. After that, all cameras ask again. */
  #gathering(): Round<void> {
    const gathered = this.#gathered;
    return {
      ask: () => {
        this.#askedVersion = this.drawing.version;
        return gathered.follow(this.drawing.present(), this.#refuseNode);
      },
      use: () => {
        this.cameras.again(gathered.points, gathered.spacing);
        if (gathered.isEmpty) {
          this.#visible = 0;
        }
        return () => {
          this.tell();
        };
      },
      isGivenUp: () => {
        this.#isFailed = true;
        return false;
      },
    };
  }

  /** Asks the cloud about a camera's view, and draws the answer. */
  #viewing(camera: FollowedCamera): Round {
    const gathered = this.#gathered;
    const version = this.#askedVersion;
    return this.view(
      camera,
      (place, stage) => gathered.see(place, stage),
      (answer, stage, place) => {
        const { radius } = answer;
        let count = 0;
        const horizon = this.#horizons.begin(camera, place, answer, stage, version);
        for (const { node, own, scores } of gathered.split(answer)) {
          if (this.drawing.isPresent(node) && node.display.drawn.isSame) {
            count += node.display.answer(camera, own, false, scores);
            if (own.length > 0) horizon?.add(node, own);
          }
        }
        gathered.recycle(answer);
        this.#visible = count;
        this.#radius = radius;
        return this.#told(place);
      },
      (texture, place) => {
        this.drawing.map(camera, texture);
        return this.#told(place);
      },
    );
  }

  #told({ from, isDirection }: Place) {
    const place = [...from];
    return {
      count: this.#visible,
      nodes: this.#gathered.nodes,
      viewpoint: isDirection ? null : place,
      direction: isDirection ? place : null,
      radius: this.#radius,
    };
  }
}
