import type { Camera, Points } from "three";

import { HprError } from "../base/errors.js";
import { Follower, type Round } from "../follow/follower.js";
import { Readiness } from "../follow/readiness.js";
import type { Visibility } from "../cloud/visibility.js";
import { boxOf, extentOf } from "./box.js";
import { type Cloud, prepareCloud } from "./cloud.js";
import { Display } from "./display.js";
import { type DrawnPoints, requireUnfiltered } from "./drawn-points.js";
import { Eye, requireUniformScale } from "./eye.js";
import { type FilterSettings, type HiddenPointFilterOptions, readFilterOptions, requirePoints } from "./options.js";
import { Reporter } from "./reporter.js";

/** The events of a filter. */
export interface HiddenPointFilterEvents {
  /** A new answer is drawn. `count` is the number of visible points. `milliseconds` is the time that it took. */
  change: { count: number; milliseconds: number };
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
 * `update` notices changes and uses the new state: positions with a new version (`needsUpdate =
 * true`), other attributes, indices, draw ranges and geometries.
 *
 * Morph targets, instances and a non-uniform scale are refused (`option`).
 */
export class HiddenPointFilter extends Reporter<HiddenPointFilterEvents> {
  /**
   * While true, the filter asks about no new view, even if the camera moves. An answer that is on
   * its way is still drawn.
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
  readonly #eye = new Eye();
  readonly #display: Display;
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
      this.#eye.look(this.#points, camera);
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
    this.#follower.wish(this.#eye.isNew || !isUnchanged);
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
    this.#display.dispose();
    this.#dropCloud();
    // The caller of dispose() knows this already, so this is never an unhandled rejection.
    this.#readiness.reject(new HprError("disposed", "this filter has been disposed of"), true);
  }

  #next(): Round | undefined {
    if (this.#isStale) {
      return this.#preparing();
    }
    return this.#cloud !== undefined && this.#wantsAnswer() ? this.#viewing(this.#cloud) : undefined;
  }

  #wantsAnswer(): boolean {
    return this.enabled && !this.frozen && this.#eye.isNew;
  }

  /** Reads the points as they are now. */
  #preparing(): Round<Cloud> {
    return {
      ask: () => {
        this.#isStale = false;
        this.#dropCloud();
        this.#display.leaveOthers();
        const read = this.#drawn.take();
        this.#eye.extent = extentOf([boxOf(read.numbers)]);
        this.#eye.forget();
        return prepareCloud(read, this.#settings);
      },
      use: (cloud) => {
        this.#cloud = cloud;
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

  #viewing(cloud: Cloud): Round<Visibility> {
    const begun = performance.now();
    return {
      ask: () => {
        const { isDirection } = this.#eye;
        const from = this.#eye.ask();
        const { view } = this.#settings;
        return isDirection ? cloud.visibleFromDirection(from, view) : cloud.visibleFrom(from, view);
      },
      use: (answer) => {
        if (!this.#drawn.isSame) {
          return undefined;
        }
        this.#display.answer(answer.indices, this.#settings.inWorker);
        cloud.recycle(answer);
        this.#follower.answered();
        this.#readiness.resolve();
        const milliseconds = performance.now() - begun;
        return () => {
          this.dispatchEvent({ type: "change", count: answer.count, milliseconds });
        };
      },
    };
  }

  #lost(isComingBack: boolean): void {
    this.#dropCloud();
    this.#isStale = true;
    if (!isComingBack && this.#eye.isNew) {
      // Another view may succeed.
      this.#eye.ask();
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
