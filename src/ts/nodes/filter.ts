import { type Camera, EventDispatcher, type EventListener, type Object3D, type Points } from "three";

import { describe, HprError } from "../errors.js";
import type { MergeOptions } from "../merge.js";
import { Eye, requireUniformScale } from "../three/eye.js";
import { extent } from "./measure.js";
import { type Merger, startMerger } from "./merger.js";
import type { CloudNode } from "./node.js";
import { NodeSet } from "./node-set.js";
import { type HiddenPointNodesFilterOptions, type NodesSettings, readNodesOptions } from "./options.js";
import { CommonRadius } from "./radius.js";
import { spacingOf } from "./spacing.js";

/** What a filter of nodes tells its listeners. */
export interface HiddenPointNodesFilterEvents {
  /**
   * Another answer is drawn: how many points of how many nodes are visible, how long it took
   * to get, and from where and with which radius (0 where the inversion has none) all were
   * asked, in the root's space.
   */
  change: { count: number; nodes: number; milliseconds: number; viewpoint: number[]; radius: number };
  /**
   * What a node (`points`) or a view (null) is refused for: told once for each node until it
   * changes, and once for views until there is an answer again.
   */
  error: { error: Error; points: Points | null };
}

/** What is asked together. */
interface Round {
  nodes: CloudNode[];
  viewpoint: number[];
  /** No node is new since the last time, and none to come. */
  settled: boolean;
  /** The nodes or the viewpoint are others than the last time. */
  isNew: boolean;
}

/**
 * Draws, of many `THREE.Points` that are one cloud together, only what can be seen from the
 * camera, as tiled viewers need it: potree-core's octrees, point tiles of 3d-tiles-renderer.
 * Nodes may come and go, lie in one another, and have offsets of their own.
 *
 * All nodes are asked from one viewpoint with one radius, each as a cloud of its own, and
 * what they see is merged (`mergeVisible`): exactly as if the cloud had never been split.
 * A node that comes is asked alone, then merged; what was asked before is kept.
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
 * Nodes may move with the root as much as they like; moved within it, they are prepared
 * anew. Nodes that have gone are kept for a while, no more points than are there.
 *
 * Orthographic cameras are refused (`option`).
 */
export class HiddenPointNodesFilter extends EventDispatcher<HiddenPointNodesFilterEvents> {
  /**
   * While true, nothing new is asked, wherever the camera goes; an answer on its way is still
   * drawn. New nodes are drawn whole.
   */
  frozen = false;

  readonly #root: Object3D;
  readonly #settings: NodesSettings;
  readonly #radius: CommonRadius;
  readonly #eye = new Eye();
  readonly #nodes: NodeSet;
  /** Versions of the set of nodes: the last one that was asked, that had settled, whose spacing is known. */
  #askedVersion = 0;
  #settledVersion = 0;
  #spacingVersion = -1;
  #asked: MergeOptions | undefined;
  #merger: Promise<Merger> | undefined;
  #enabled = true;
  #busy = false;
  #visible = 0;
  #refused = false;
  #recovering = false;
  #disposed = false;
  #isHeard = false;

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
    this.#radius = new CommonRadius(this.#settings.view);
    this.#nodes = new NodeSet(root, this.#settings, {
      ready: () => {
        this.#next();
      },
      refused: (error, points) => {
        this.#refuseNode(error, points);
      },
    });
    requireUniformScale(root);
  }

  /** While false, everything is drawn and nothing is asked. Default true. */
  get enabled(): boolean {
    return this.#enabled;
  }

  set enabled(enabled: boolean) {
    this.#enabled = enabled;
    for (const node of this.#nodes.all()) {
      if (!enabled) {
        node.showAll();
      } else if (this.#nodes.isPresent(node)) {
        node.show();
      }
    }
  }

  /** How many points are visible, of all nodes together, in the answer that came last. */
  get visibleCount(): number {
    return this.#visible;
  }

  /** Whether what is drawn is the answer for the nodes and the camera of the last `update`. */
  get settled(): boolean {
    return !this.#busy && !this.#nodes.isBuilding && !this.#wantsAnswer();
  }

  /**
   * To be called each frame, when the nodes have been chosen and before rendering: asks for
   * an answer if the view or the nodes are new. Never waits.
   */
  update(camera: Camera): void {
    if (this.#disposed) {
      return;
    }
    for (const node of this.#nodes.all()) {
      node.dimmed?.follow();
    }
    if (!this.#enabled || this.frozen) {
      return;
    }
    try {
      this.#eye.look(this.#root, camera);
      if (this.#eye.isDirection) {
        throw new HprError("option", "camera: nodes cannot be merged along a direction, as an orthographic camera sees them");
      }
      this.#nodes.takeUp();
    } catch (error) {
      this.#refuse(error);
      return;
    }
    this.#next();
  }

  /** `"change"`: another answer is drawn. `"error"`: without a listener, it is an unhandled rejection. */
  override addEventListener<T extends keyof HiddenPointNodesFilterEvents>(
    type: T,
    listener: EventListener<HiddenPointNodesFilterEvents[T], T, this>,
  ): void {
    this.#isHeard ||= type === "error";
    super.addEventListener(type, listener);
  }

  /** Draws all nodes as they were, and gives the memory of their clouds back. May be called twice. */
  dispose(): void {
    if (this.#disposed) {
      return;
    }
    this.#disposed = true;
    this.#nodes.dispose();
    this.#dropMerger();
  }

  #wantsAnswer(): boolean {
    const { version, isKnown } = this.#nodes;
    const isNew = this.#eye.isNew || this.#askedVersion !== version || this.#settledVersion !== version;
    return isNew && isKnown && this.#enabled && !this.frozen && !this.#disposed;
  }

  #next(): void {
    if (this.#busy || !this.#wantsAnswer()) {
      return;
    }
    const { version, isBuilding, epoch } = this.#nodes;
    const isNewSet = this.#askedVersion !== version;
    const isNew = isNewSet || this.#eye.isNew;
    if (!isNew && isBuilding) {
      return;
    }
    const nodes = this.#nodes.ready();
    const settled = !isNewSet && !isBuilding;
    this.#eye.extent = extent(nodes.map(({ measure }) => measure!));
    const viewpoint = this.#eye.ask();
    this.#askedVersion = version;
    if (settled || nodes.length === 0) {
      this.#settledVersion = version;
    }
    if (nodes.length === 0) {
      this.#visible = 0;
      return;
    }
    this.#busy = true;
    this.#answer({ nodes, viewpoint, settled, isNew }).then(
      () => {
        this.#busy = false;
        this.#next();
      },
      (error: unknown) => {
        this.#busy = false;
        if (epoch === this.#nodes.epoch && !isDisposed(error)) {
          this.#refuse(error);
        }
        this.#next();
      },
    );
  }

  async #answer({ nodes, viewpoint, settled, isNew }: Round): Promise<void> {
    const begun = performance.now();
    const options = await this.#chooseRadius(nodes, viewpoint, settled);
    if (!isNew && JSON.stringify(options) === JSON.stringify(this.#asked)) {
      return;
    }
    const seen = await Promise.all(nodes.map((node) => node.visibleFrom(viewpoint, options)));
    let first = 0;
    const parts = nodes.map((node, i) => {
      const part = node.part(seen[i]!, first);
      first += node.drawn.total;
      return part;
    });
    const ids = await (await this.#startedMerger()).merge(parts, viewpoint, options);
    this.#asked = options;
    if (!this.#disposed) {
      this.#draw(nodes, ids);
      const milliseconds = performance.now() - begun;
      const { radius = 0 } = options;
      this.dispatchEvent({ type: "change", count: ids.length, nodes: nodes.length, milliseconds, viewpoint, radius });
    }
  }

  /** What all nodes are asked with. Their spacing is measured when they have settled. */
  async #chooseRadius(nodes: CloudNode[], viewpoint: number[], settled: boolean): Promise<MergeOptions> {
    const radius = this.#radius;
    const isUnknown = radius.spacing === undefined || (settled && this.#spacingVersion !== this.#askedVersion);
    if (radius.needsSpacing && isUnknown) {
      const version = this.#askedVersion;
      radius.spacing = await spacingOf(nodes, this.#settings);
      this.#spacingVersion = settled ? version : -1;
    }
    return radius.choose(
      nodes.map(({ measure }) => measure!),
      viewpoint,
      settled,
    );
  }

  #draw(nodes: CloudNode[], ids: Uint32Array): void {
    this.#refused = this.#recovering = false;
    this.#visible = ids.length;
    let [first, from] = [0, 0];
    for (const node of nodes) {
      const next = first + node.drawn.total;
      let to = from;
      while (to < ids.length && ids[to]! < next) to++;
      if (node.state === "ready" && node.drawn.isSame && this.#nodes.isPresent(node)) {
        const base = first;
        node.drawn.setVisible(ids.subarray(from, to).map((id) => id - base));
        if (this.#enabled) {
          node.show();
        }
      }
      [first, from] = [next, to];
    }
  }

  #refuseNode(error: Error, points: Points): void {
    if (this.#disposed || this.#recover(error)) {
      return;
    }
    this.#tell(error, points);
    this.#next();
  }

  #refuse(thrown: unknown): void {
    const error = thrown instanceof Error ? thrown : new Error(String(thrown));
    if (this.#disposed || this.#recover(error) || this.#refused) {
      return;
    }
    this.#refused = true;
    this.#tell(error, null);
  }

  /** Once in a row: with the worker, all clouds are lost. */
  #recover(error: Error): boolean {
    if (!(error instanceof HprError) || error.code !== "internal" || this.#recovering) {
      return false;
    }
    this.#recovering = true;
    this.#dropMerger();
    this.#nodes.rebuild();
    return true;
  }

  /** What nobody listens to is reported as any other promise that nobody awaits. */
  #tell(error: Error, points: Points | null): void {
    if (!this.#isHeard) {
      void Promise.reject(error);
    }
    this.dispatchEvent({ type: "error", error, points });
  }

  #startedMerger(): Promise<Merger> {
    this.#merger ??= startMerger(this.#settings.inWorker).catch((error: unknown) => {
      this.#merger = undefined;
      throw error;
    });
    return this.#merger;
  }

  #dropMerger(): void {
    const merger = this.#merger;
    this.#merger = undefined;
    // One that could not be started has nothing to give back.
    merger?.then((started) => started.dispose()).catch(() => undefined);
  }
}

/** Of a node that changed while it was asked: it is asked again. */
function isDisposed(error: unknown): boolean {
  return error instanceof HprError && error.code === "disposed";
}
