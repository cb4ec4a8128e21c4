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

/** What a filter of nodes tells its listeners. */
export interface HiddenPointNodesFilterEvents {
  /**
   * Another answer is drawn: how many points of how many nodes are visible, how long it took
   * to get, from which viewpoint or along which direction (the other one is null) and with
   * which radius (0 where the inversion has none), in the root's space.
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
   * What a node (`points`) or a view (null) is refused for: told once for each node until it
   * changes, and once for views until there is an answer again. Without a listener, it is an
   * unhandled rejection.
   */
  error: { error: Error; points: Points | null };
}

/** An answer, and the viewpoint or the direction that it was asked for. */
interface Asked {
  answer: Visibility;
  viewpoint: number[] | null;
  direction: number[] | null;
}

/**
 * Draws, of many `THREE.Points` that are one cloud together, only what can be seen from the
 * camera, as tiled viewers need it: potree-core's octrees, point tiles of 3d-tiles-renderer.
 * Nodes may come and go, lie in one another, and have offsets of their own.
 *
 * What is drawn is, to the bit, what would be drawn of one cloud that had never been split:
 * nodes that come are appended to it, nodes that go are removed.
 *
 * ```js
 * const filter = new HiddenPointNodesFilter(octree); // or tiles.group
 * renderer.setAnimationLoop(() => {
 *   viewer.update(camera); // whatever chooses the nodes
 *   filter.update(camera);
 *   renderer.render(scene, camera);
 * });
 * ```
 *
 * Nodes may move with the root as much as they like; moved within it, they are read anew.
 * The options are those of a `HiddenPointFilter`, and mean the cloud of all nodes; so does an
 * orthographic camera.
 */
export class HiddenPointNodesFilter extends Reporter<HiddenPointNodesFilterEvents> {
  /**
   * While true, nothing new is asked, wherever the camera goes; an answer on its way is still
   * drawn. New nodes are drawn whole.
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
  /** The set of nodes that was asked last; undefined when it is to be asked again. */
  #askedVersion: number | undefined;
  /** Whether the cloud was lost with its worker and is to be made again. */
  #isDropped = false;
  #visible = 0;
  #disposed = false;
  /** What listeners are told when everything else is done: they may throw. */
  #untold: { error: Error; points: Points | null }[] = [];
  readonly #refuseNode: Refused = (error, points) => {
    this.#untold.push({ error, points });
  };

  /**
   * @param root in whose space the nodes are one cloud, and radii are given: an object
   *   that they are all below.
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

  /** How many points are visible, of all nodes together, in the answer that came last. */
  get visibleCount(): number {
    return this.#visible;
  }

  /**
   * Whether nothing is on its way: what is drawn is the answer for the nodes and the camera of
   * the last `update`, unless that was refused.
   */
  get settled(): boolean {
    return !this.#follower.isWaiting && (this.#follower.isLost || !this.#wantsAnswer());
  }

  /**
   * To be called each frame, when the nodes have been chosen and before rendering: asks for
   * an answer if the view or the nodes are new. Never waits.
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

  /** Draws all nodes as they were, and gives the memory of their cloud back. May be called twice. */
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

  /** Brings the cloud up to date, asks it for the newest view, and draws that. */
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

  /** Undefined if no node has a point. */
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
      // Another view may do better.
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
