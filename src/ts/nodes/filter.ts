import type { Camera, Object3D, Points } from "three";

import { describe, HprError } from "../errors.js";
import { type Box, extentOf } from "../three/box.js";
import { Eye, requireUniformScale } from "../three/eye.js";
import { Recovery } from "../three/recovery.js";
import { asError, Reporter } from "../three/reporter.js";
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
  readonly #recovery = new Recovery(() => {
    this.#askedVersion = undefined;
    this.#next();
  });
  /** The set of nodes that was asked last; undefined when it is to be asked again. */
  #askedVersion: number | undefined;
  #busy = false;
  #visible = 0;
  /** A view was refused, and nothing has been answered since. */
  #refused = false;
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
    return !this.#busy && !this.#recovery.isUnderWay && (this.#recovery.isLost || !this.#wantsAnswer());
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
      this.#recovery.wish(this.#wantsAnswer());
      this.#next();
    } catch (error) {
      this.#refuse(error);
    }
    this.#tell();
  }

  /** Draws all nodes as they were, and gives the memory of their cloud back. May be called twice. */
  dispose(): void {
    if (this.#disposed) {
      return;
    }
    this.#disposed = true;
    this.#nodes.dispose();
    this.#gathered.close();
    this.#recovery.stop();
  }

  #wantsAnswer(): boolean {
    const isNew = this.#eye.isNew || this.#askedVersion !== this.#nodes.version;
    return isNew && this.enabled && !this.frozen && !this.#disposed;
  }

  #next(): void {
    if (this.#busy || this.#recovery.isLost || !this.#wantsAnswer()) {
      return;
    }
    this.#busy = true;
    void this.#round().then(
      (change) => {
        this.#busy = false;
        this.#next();
        this.#tell();
        if (change !== undefined && !this.#disposed) {
          this.dispatchEvent({ type: "change", ...change });
        }
      },
      (error: unknown) => {
        this.#busy = false;
        this.#refuse(error);
        this.#next();
        this.#tell();
      },
    );
  }

  /** Brings the cloud up to date, asks it for the newest view, and draws that. */
  async #round(): Promise<HiddenPointNodesFilterEvents["change"] | undefined> {
    const begun = performance.now();
    const gathered = this.#gathered;
    this.#askedVersion = this.#nodes.version;
    await gathered.follow(this.#nodes.present(), this.#refuseNode);
    this.#eye.extent = extentOf(this.#nodes.present().flatMap(({ box }): Box[] => (box === undefined ? [] : [box])));
    const { isDirection } = this.#eye;
    const from = this.#eye.ask();
    if (gathered.isEmpty) {
      this.#visible = 0;
      return undefined;
    }
    const answer = await gathered.visibleFrom(from, isDirection);
    const { count, radius } = answer;
    if (this.#disposed) {
      return undefined;
    }
    for (const [node, own] of gathered.split(answer.indices)) {
      if (this.#nodes.isPresent(node) && node.display.drawn.isSame) {
        node.display.answer(own);
      }
    }
    gathered.recycle(answer);
    this.#visible = count;
    this.#refused = false;
    this.#recovery.answered();
    const milliseconds = performance.now() - begun;
    const [viewpoint, direction] = isDirection ? [null, from] : [from, null];
    return { count, nodes: gathered.nodes, milliseconds, viewpoint, direction, radius };
  }

  #refuse(thrown: unknown): void {
    if (this.#disposed) {
      return;
    }
    const error = asError(thrown);
    if (this.#recovery.notices(error)) {
      this.#gathered.drop();
      if (this.#recovery.isUnderWay) {
        return;
      }
      // Another view may do better.
      if (this.#eye.isNew) this.#eye.ask();
    }
    if (!this.#refused) {
      this.#refused = true;
      this.#untold.push({ error, points: null });
    }
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
