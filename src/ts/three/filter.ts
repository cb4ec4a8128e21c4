import type { Camera, Points } from "three";

import { HprError } from "../base/errors.js";
import { Follower, type Round } from "../follow/follower.js";
import type { AnswerKind, Turn } from "../follow/gaze.js";
import { Readiness } from "../follow/readiness.js";
import { turnRound } from "../follow/turn-round.js";
import type { Visibility } from "../cloud/visibility.js";
import { type Cloud, prepareCloud, see } from "./cloud.js";
import { Display } from "./display.js";
import { type DrawnPoints, requireUnfiltered } from "./drawn-points.js";
import { requireUniformScale } from "./eye.js";
import { type FilterSettings, type HiddenPointFilterOptions, readFilterOptions, requirePoints } from "./options.js";
import { Reporter } from "./reporter.js";
import { type Watch, Watches } from "./watch.js";

/** The events of a filter. */
export interface HiddenPointFilterEvents {
  /**
   * A new answer for a camera. `count` is the number of points that are drawn. `milliseconds` is the
   * time that it took. `answer` says what it is: a draft comes before the exact answer.
   */
  change: { count: number; milliseconds: number; answer: AnswerKind; camera: Camera };
  /**
   * A view or the points were refused. This comes only once until there is an answer again. Without
   * a listener, the error is an unhandled rejection.
   */
  error: { error: Error };
}

/**
 * Draws only those points of a `THREE.Points` that the camera sees, and lets rays pick only these.
 * To do so, it replaces the geometry's index and draw range until it is disposed of. Points that
 * the geometry's own index and draw range leave out are ignored. Attributes, materials and the
 * user's own index stay untouched.
 *
 * ```js
 * const filter = new HiddenPointFilter(points);
 * renderer.setAnimationLoop(() => {
 *   filter.update(camera);
 *   renderer.render(scene, camera);
 * });
 * ```
 *
 * The camera's place is converted to the points' own space, and a radius is in the units of this
 * space. So moving the points or the camera makes a new view. Turning a perspective camera or
 * changing its field of view does not. An orthographic camera sees along a direction
 * (`visibleFromDirection`): only turning it makes a new view.
 *
 * In motion, the newest draft is drawn. Then comes the exact answer, and at rest the answer of the
 * option `settle`. Several cameras may look at the points: call `update` with each of them, before its
 * picture is rendered. Each has its own answers of one cloud.
 *
 * `update` notices changes and uses the new state: positions with a new version (`needsUpdate =
 * true`), other attributes, indices, draw ranges and geometries.
 *
 * Morph targets, instances and a non-uniform scale are refused (`option`).
 */
export class HiddenPointFilter extends Reporter<HiddenPointFilterEvents> {
  /**
   * While true, the filter asks about no new view, even if the camera moves. An answer that is on
   * its way is still drawn, and so are better answers for the same view.
   */
  frozen = false;
  readonly #readiness = new Readiness();
  /**
   * Resolves when the points are prepared. If `update` was called before that, this resolves when
   * the first answer is drawn. Rejects with the error if the points or that view are refused.
   */
  readonly ready: Promise<void> = this.#readiness.promise;

  readonly #points: Points;
  readonly #settings: FilterSettings;
  readonly #display: Display;
  readonly #watches: Watches;
  readonly #follower = new Follower({
    next: () => this.#next(),
    refused: (error, again) => {
      this.#refused(error, again);
    },
    lost: (isComingBack) => {
      this.#lost(isComingBack);
    },
  });
  #cloud: Cloud | undefined;
  /** Whether the points must be read before anything else. */
  #isStale = true;
  /** Whether a camera has moved since the cloud was lost. */
  #isMoved = false;
  #disposed = false;

  /**
   * @param points the points. From now on, the filter owns their index and draw range.
   * @throws HprError `option`, `positions-type`, `too-large`. Errors that only the core can find
   *   (`non-finite`, the range of an option) may reject `ready` instead.
   */
  constructor(points: Points, options?: HiddenPointFilterOptions) {
    super();
    requirePoints(points);
    this.#points = points;
    this.#settings = readFilterOptions(options);
    requireUnfiltered(points.geometry);
    requireUniformScale(points);
    this.#display = new Display(points, this.#settings);
    this.#watches = new Watches(
      this.#settings,
      () => {
        this.#follower.follow();
      },
      (watch) => {
        this.#drawn.drop(watch);
      },
    );
    try {
      this.#follower.follow(true);
    } catch (error) {
      this.#display.dispose();
      throw error;
    }
  }

  /** While false, everything is drawn and nothing is asked. Default true. */
  get enabled(): boolean {
    return this.#display.enabled;
  }

  set enabled(enabled: boolean) {
    this.#display.enabled = enabled;
  }

  /** The indices of the points that are drawn, without the dimmed ones: a copy, in the order of drawing. */
  get visible(): Uint32Array {
    return this.#display.drawnIndices;
  }

  /** What is drawn for the camera of the last `update`. Null before the first answer. */
  get answer(): AnswerKind | null {
    return this.#watches.last?.answer ?? null;
  }

  /**
   * Whether the answer that is drawn belongs to the present view of the camera of the last `update`. If
   * not, it belongs to an earlier view.
   */
  get isCurrent(): boolean {
    return this.#watches.last?.isCurrent ?? false;
  }

  /** How many points are drawn, without the dimmed ones. Before the first answer, this is all points. */
  get visibleCount(): number {
    return this.#display.count;
  }

  /**
   * Call this in each frame, before rendering. It asks for an answer if the view is new, and draws
   * the answer when it arrives (with `worker: false`, at once). While one view is being answered,
   * only the newest of the later views is kept.
   */
  update(camera: Camera): void {
    if (this.#disposed) {
      return;
    }
    try {
      this.#display.follow();
      if (!this.enabled || this.frozen) {
        return;
      }
      this.#look(camera);
    } catch (error) {
      this.#follower.refuse(error);
      return;
    }
    const { isUnchanged } = this.#drawn;
    if (this.#follower.isBusy || this.#follower.isLost) {
      // The answer on its way may be about other points.
      this.#display.leaveOthers();
    } else if (!isUnchanged) {
      this.#isStale = true;
    }
    this.#follower.wish(this.#isMoved || !isUnchanged);
  }

  #look(camera: Camera): void {
    const watch = this.#watches.of(camera);
    this.#display.select(watch);
    if (this.#watches.look(watch, this.#points)) {
      this.#isMoved = true;
      if (this.#settings.stale === "all") {
        this.#display.setStale(watch);
        watch.drawn = undefined;
      }
    }
  }

  /**
   * Draws everything again: index, draw range and children are as they were. Also frees the cloud's
   * memory. May be called twice.
   */
  dispose(): void {
    if (this.#disposed) {
      return;
    }
    this.#disposed = true;
    this.#follower.stop();
    this.#watches.stop();
    this.#display.dispose();
    this.#dropCloud();
    // The caller of dispose() knows this already, so this is never an unhandled rejection.
    this.#readiness.reject(new HprError("disposed", "this filter has been disposed of"), true);
  }

  #next(): Round | undefined {
    if (this.#isStale) {
      return this.#preparing();
    }
    const watch = this.enabled ? this.#watches.due(this.frozen) : undefined;
    return this.#cloud !== undefined && watch !== undefined ? this.#viewing(this.#cloud, watch) : undefined;
  }

  /** Reads the points as they are now. */
  #preparing(): Round<Cloud> {
    return {
      ask: () => {
        this.#isStale = false;
        this.#dropCloud();
        this.#display.leaveOthers();
        return prepareCloud(this.#drawn.take(), this.#settings);
      },
      use: (cloud) => {
        this.#cloud = cloud;
        this.#watches.again(cloud.length, cloud.spacing);
        // If `update` is called in the same task, `ready` waits for the answer.
        queueMicrotask(() => {
          if (!this.#follower.isBusy) {
            this.#readiness.resolve();
          }
        });
        return undefined;
      },
      leave: (cloud) => void cloud.dispose(),
    };
  }

  #viewing(cloud: Cloud, watch: Watch): Round<Visibility> {
    const begun = performance.now();
    const { place } = watch.eye;
    return turnRound(
      watch.gaze,
      ({ options, signal }) => see(cloud, place, options, signal),
      (answer, turn) => {
        const isOutdated = this.#settings.stale === "all" && !turn.isCurrent();
        if (!this.#drawn.isSame || isOutdated) {
          return undefined;
        }
        const count = this.#show(answer, turn, watch);
        cloud.recycle(answer);
        const change = { count, milliseconds: performance.now() - begun, answer: turn.kind };
        return () => {
          this.dispatchEvent({ type: "change", ...change, camera: watch.camera });
        };
      },
    );
  }

  /** Returns the number of points that are drawn. */
  #show({ indices, scores }: Visibility, turn: Turn, watch: Watch): number {
    const count = this.#display.answer(watch, indices, this.#settings.inWorker, scores);
    watch.drawn = turn;
    this.#follower.answered();
    if (turn.kind !== "draft") {
      this.#readiness.resolve();
    }
    return count;
  }

  #lost(isComingBack: boolean): void {
    this.#dropCloud();
    this.#isStale = true;
    if (!isComingBack) {
      // Another view may succeed.
      this.#isMoved = false;
    }
  }

  #refused(error: Error, again: boolean): void {
    if (!again) {
      this.#readiness.reject(error, this.isHeard);
      this.dispatchEvent({ type: "error", error });
    }
  }

  get #drawn(): DrawnPoints {
    return this.#display.drawn;
  }

  #dropCloud(): void {
    void this.#cloud?.dispose();
    this.#cloud = undefined;
  }
}
