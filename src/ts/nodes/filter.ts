import type { Camera, Object3D, Points } from "three";

import { describe, HprError } from "../base/errors.js";
import { Follower, type Round } from "../follow/follower.js";
import { type Box, extentOf } from "../three/box.js";
import { Eye, requireUniformScale } from "../three/eye.js";
import { Reporter } from "../three/reporter.js";
import type { Visibility } from "../cloud/visibility.js";
import { Gathered } from "./gathered.js";
import type { Refused } from "./node.js";
import { NodeSet } from "./node-set.js";
import { type HiddenPointNodesFilterOptions, type NodesSettings, readNodesOptions } from "./options.js";

/** The events of a filter of nodes. */
export interface HiddenPointNodesFilterEvents {
  /**
   * A new answer is drawn. `count` is the number of visible points. `nodes` is the number of nodes
   * in the cloud. Either `viewpoint` or `direction` is null. `radius` is 0 if the inversion has none.
   * The viewpoint, the direction and the radius are in the root's space.
   */
  change: {
    count: number;
    nodes: number;
    milliseconds: number;
    viewpoint: number[] | null;
    direction: number[] | null;
    radius: number;
  };
  /**
   * A node (`points`) or a view (`points` is null) is refused. For a node, this comes only once
   * until the node changes. For views, it comes only once until there is an answer again. Without a
   * listener, the error is an unhandled rejection.
   */
  error: { error: Error; points: Points | null };
}

/** An answer, and the viewpoint or the direction that it belongs to. */
interface Asked {
  answer: Visibility;
  viewpoint: number[] | null;
  direction: number[] | null;
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
 * cameras are handled as in that filter, too.
 */
export class HiddenPointNodesFilter extends Reporter<HiddenPointNodesFilterEvents> {
  /**
   * While true, the filter asks about no new view, even if the camera moves. An answer that is on
   * its way is still drawn. All points of new nodes are drawn.
   */
  frozen = false;

  readonly #root: Object3D;
  readonly #settings: NodesSettings;
  readonly #eye = new Eye();
  readonly #nodes: NodeSet;
  readonly #gathered: Gathered;
  readonly #follower = new Follower({
    next: () => this.#next(),
    refused: (error, again) => {
      if (!again) this.#untold.push({ error, points: null });
      this.#tell();
    },
    lost: (isComingBack) => {
      this.#lost(isComingBack);
    },
  });
  /**
   * The version of the set of nodes that the last question was about. Undefined if the question
   * must be asked again.
   */
  #askedVersion: number | undefined;
  /** Whether the cloud was lost with its worker and must be made again. */
  #isDropped = false;
  #visible = 0;
  #disposed = false;
  /** The errors that listeners have not received yet. They are sent last, because listeners may throw. */
  #untold: { error: Error; points: Points | null }[] = [];
  readonly #refuseNode: Refused = (error, points) => {
    this.#untold.push({ error, points });
  };

  /**
   * @param root an object above all nodes. The nodes are one cloud in the space of this object, and
   *   a radius is in the units of this space.
   * @throws HprError `option`.
   */
  constructor(root: Object3D, options?: HiddenPointNodesFilterOptions) {
    super();
    if (typeof (root as unknown) !== "object" || (root as unknown) === null || !("isObject3D" in root)) {
      throw new HprError("option", `root must be a THREE.Object3D, got ${describe(root)}`);
    }
    this.#root = root;
    this.#settings = readNodesOptions(options);
    this.#nodes = new NodeSet(root, this.#settings, this.#refuseNode);
    this.#gathered = new Gathered(this.#settings);
    requireUniformScale(root);
  }

  /** While false, everything is drawn and nothing is asked. Default true. */
  get enabled(): boolean {
    return this.#nodes.enabled;
  }

  set enabled(enabled: boolean) {
    this.#nodes.enabled = enabled;
  }

  /** The number of visible points of all nodes, in the last answer. */
  get visibleCount(): number {
    return this.#visible;
  }

  /**
   * Whether no answer is on its way. Then the picture shows the answer for the nodes and the camera
   * of the last `update`, unless these were refused.
   */
  get settled(): boolean {
    return !this.#follower.isWaiting && (this.#follower.isLost || !this.#wantsAnswer());
  }

  /**
   * Call this in each frame, after the nodes have been chosen and before rendering. It asks for an
   * answer if the view or the nodes are new. It never waits.
   */
  update(camera: Camera): void {
    if (this.#disposed) {
      return;
    }
    try {
      this.#nodes.follow();
      if (!this.enabled || this.frozen) {
        return;
      }
      this.#eye.look(this.#root, camera);
      this.#nodes.takeUp();
    } catch (error) {
      this.#follower.refuse(error);
      return;
    }
    this.#follower.wish(this.#wantsAnswer());
    this.#tell();
  }

  /** Draws all nodes as they were, and frees the memory of their cloud. May be called twice. */
  dispose(): void {
    if (this.#disposed) {
      return;
    }
    this.#disposed = true;
    this.#follower.stop();
    this.#nodes.dispose();
    this.#gathered.close();
  }

  #wantsAnswer(): boolean {
    const isNew = this.#eye.isNew || this.#askedVersion !== this.#nodes.version;
    return isNew && this.enabled && !this.frozen && !this.#disposed;
  }

  #next(): Round | undefined {
    if (this.#isDropped) {
      this.#isDropped = false;
      this.#askedVersion = undefined;
    }
    return this.#wantsAnswer() ? this.#viewing() : undefined;
  }

  /** Updates the cloud, asks it about the newest view, and draws the answer. */
  #viewing(): Round<Asked | undefined> {
    const begun = performance.now();
    const gathered = this.#gathered;
    return {
      ask: () => this.#ask(),
      use: (asked) => {
        if (asked === undefined) {
          this.#visible = 0;
          return () => {
            this.#tell();
          };
        }
        const { answer, viewpoint, direction } = asked;
        const { count, radius } = answer;
        for (const [node, own] of gathered.split(answer.indices)) {
          if (this.#nodes.isPresent(node) && node.display.drawn.isSame) {
            node.display.answer(own);
          }
        }
        gathered.recycle(answer);
        this.#visible = count;
        this.#follower.answered();
        const milliseconds = performance.now() - begun;
        const change = { count, nodes: gathered.nodes, milliseconds, viewpoint, direction, radius };
        return () => {
          this.#tell();
          this.dispatchEvent({ type: "change", ...change });
        };
      },
    };
  }

  /** Updates the cloud and asks it. Returns undefined if no node has a point. */
  async #ask(): Promise<Asked | undefined> {
    const gathered = this.#gathered;
    this.#askedVersion = this.#nodes.version;
    await gathered.follow(this.#nodes.present(), this.#refuseNode);
    this.#eye.extent = extentOf(this.#nodes.present().flatMap(({ box }): Box[] => (box === undefined ? [] : [box])));
    const { isDirection } = this.#eye;
    const from = this.#eye.ask();
    if (gathered.isEmpty) {
      return undefined;
    }
    const answer = await gathered.visibleFrom(from, isDirection);
    return isDirection ? { answer, viewpoint: null, direction: from } : { answer, viewpoint: from, direction: null };
  }

  #lost(isComingBack: boolean): void {
    this.#gathered.drop();
    this.#isDropped = true;
    if (!isComingBack && this.#eye.isNew) {
      // Another view may succeed.
      this.#eye.ask();
    }
    this.#tell();
  }

  #tell(): void {
    for (const told of this.#untold.splice(0)) {
      if (!this.isHeard) {
        void Promise.reject(told.error);
      }
      this.dispatchEvent({ type: "error", ...told });
    }
  }
}
