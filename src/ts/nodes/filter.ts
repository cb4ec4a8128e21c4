import type { Camera, Object3D, Points } from "three";

import { describe, HprError } from "../base/errors.js";
import { Follower, type Round } from "../follow/follower.js";
import type { AnswerKind } from "../follow/gaze.js";
import { turnRound } from "../follow/turn-round.js";
import { requireUniformScale } from "../three/eye.js";
import { Reporter } from "../three/reporter.js";
import { type Watch, Watches } from "../three/watch.js";
import type { Visibility } from "../cloud/visibility.js";
import { Gathered } from "./gathered.js";
import type { Refused } from "./node.js";
import { NodeHorizons } from "./node-horizons.js";
import { NodeSet } from "./node-set.js";
import { type HiddenPointNodesFilterOptions, type NodesSettings, readNodesOptions } from "./options.js";

/** The events of a filter of nodes. */
export interface HiddenPointNodesFilterEvents {
  /**
   * A new answer is drawn. `count` is the number of visible points. `nodes` is the number of nodes
   * in the cloud. `answer` says what the answer is: a draft comes before the exact one. Either `viewpoint` or `direction` is null. `radius` is 0 if the inversion has none.
   * The viewpoint, the direction and the radius are in the root's space.
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
export class HiddenPointNodesFilter extends Reporter<HiddenPointNodesFilterEvents> {
  /**
   * While true, the filter asks about no new view, even if the camera moves. An answer that is on
   * its way is still drawn, and so are better answers for the same view. The option `pending` says how
   * new nodes are drawn.
   */
  frozen = false;

  readonly #root: Object3D;
  readonly #settings: NodesSettings;
  readonly #watches: Watches;
  readonly #nodes: NodeSet;
  readonly #gathered: Gathered;
  readonly #horizons: NodeHorizons;
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
  /** Whether the cloud could not be made. It is made again when a camera moves or the nodes change. */
  #isFailed = false;
  /** Whether a camera or the nodes have changed since the cloud was lost. */
  #isMoved = false;
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
    this.#horizons = new NodeHorizons(this.#nodes, (error) => {
      this.#untold.push({ error, points: null });
      this.#tell();
    });
    this.#watches = new Watches(
      this.#settings,
      () => {
        this.#follower.follow();
      },
      (watch) => {
        this.#nodes.drop(watch);
        this.#horizons.drop(watch);
      },
    );
    requireUniformScale(root);
  }

  /** While false, everything is drawn and nothing is asked. Default true. */
  get enabled(): boolean {
    return this.#nodes.enabled;
  }

  set enabled(enabled: boolean) {
    this.#nodes.enabled = enabled;
  }

  /** The indices of each node's points that are drawn, without the dimmed ones: copies. */
  get visible(): Map<Points, Uint32Array> {
    return this.#nodes.drawn;
  }

  /** What is drawn for the camera of the last `update`. Null before the first answer. */
  get answer(): AnswerKind | null {
    return this.#watches.last?.answer ?? null;
  }

  /** Whether the answer that is drawn belongs to the present view of the camera of the last `update`. */
  get isCurrent(): boolean {
    return this.#watches.last?.isCurrent ?? false;
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
    if (this.#follower.isWaiting || this.#follower.isLost) {
      return !this.#follower.isWaiting;
    }
    const isIdle = this.frozen || !this.enabled || this.#disposed || this.#gathered.isEmpty;
    return !this.#wantsAnswer() && (isIdle || this.#watches.isComplete);
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
    return this.#horizons.hidesBox(this.enabled ? this.#watches.last : undefined, min, max);
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
      const watch = this.#watches.of(camera);
      this.#nodes.select(watch);
      if (this.#watches.look(watch, this.#root)) {
        this.#isMoved = true;
        this.#horizons.drop(watch);
        if (this.#isFailed) {
          this.#isFailed = false;
          this.#askedVersion = undefined;
        }
      }
      this.#nodes.takeUp();
      if (this.#settings.stale === "all" && !watch.isCurrent && watch.drawn !== undefined) {
        this.#nodes.setStale(watch);
        watch.drawn = undefined;
      }
    } catch (error) {
      this.#follower.refuse(error);
      return;
    }
    this.#follower.wish(this.#isMoved || this.#isChanged);
    this.#tell();
  }

  /** Draws all nodes as they were, and frees the memory of their cloud. May be called twice. */
  dispose(): void {
    if (this.#disposed) {
      return;
    }
    this.#disposed = true;
    this.#follower.stop();
    this.#watches.stop();
    this.#nodes.dispose();
    this.#gathered.close();
    this.#horizons.clear();
  }

  /** Whether the nodes are not those of the last question. */
  get #isChanged(): boolean {
    return this.#askedVersion !== this.#nodes.version;
  }

  #wantsAnswer(): boolean {
    if (!this.enabled || this.#disposed) {
      return false;
    }
    const isViewDue = !this.#gathered.isEmpty && this.#watches.due(this.frozen) !== undefined;
    return isViewDue || (this.#isChanged && !this.frozen);
  }

  #next(): Round | undefined {
    if (this.#isDropped) {
      this.#isDropped = false;
      this.#askedVersion = undefined;
    }
    if (!this.#wantsAnswer()) {
      return undefined;
    }
    return this.#isChanged && !this.frozen ? this.#gathering() : this.#viewing(this.#watches.due(this.frozen)!);
  }

  /** Updates the cloud. After that, all cameras ask again. */
  #gathering(): Round<void> {
    const gathered = this.#gathered;
    return {
      ask: () => {
        this.#askedVersion = this.#nodes.version;
        return gathered.follow(this.#nodes.present(), this.#refuseNode);
      },
      use: () => {
        this.#watches.again(gathered.points, gathered.spacing);
        if (gathered.isEmpty) {
          this.#visible = 0;
        }
        return () => {
          this.#tell();
        };
      },
      isGivenUp: () => {
        this.#isFailed = true;
        return false;
      },
    };
  }

  /** Asks the cloud about a camera's view, and draws the answer. */
  #viewing(watch: Watch): Round<Visibility> {
    const begun = performance.now();
    const gathered = this.#gathered;
    const { place } = watch.eye;
    const version = this.#askedVersion;
    return turnRound(
      watch.gaze,
      ({ options, signal }) => gathered.visibleFrom(place, options, signal),
      (answer, turn) => {
        const { radius } = answer;
        if (this.#settings.stale === "all" && !turn.isCurrent()) {
          return undefined;
        }
        let count = 0;
        const horizon = this.#horizons.begin(watch, place, answer, turn, version);
        for (const { node, own, scores } of gathered.split(answer)) {
          if (this.#nodes.isPresent(node) && node.display.drawn.isSame) {
            count += node.display.answer(watch, own, false, scores);
            if (own.length > 0) horizon?.add(node, own);
          }
        }
        gathered.recycle(answer);
        this.#visible = count;
        watch.drawn = turn;
        this.#follower.answered();
        const milliseconds = performance.now() - begun;
        const { from, isDirection } = place;
        const change = {
          count,
          nodes: gathered.nodes,
          milliseconds,
          viewpoint: isDirection ? null : [...from],
          direction: isDirection ? [...from] : null,
          radius,
          answer: turn.kind,
          camera: watch.camera,
        };
        return () => {
          this.#tell();
          this.dispatchEvent({ type: "change", ...change });
        };
      },
    );
  }

  #lost(isComingBack: boolean): void {
    this.#gathered.drop();
    this.#isDropped = true;
    if (!isComingBack) {
      // Another view may succeed.
      this.#isMoved = false;
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
