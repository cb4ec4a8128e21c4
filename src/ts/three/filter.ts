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

/** What a filter tells its listeners. */
export interface HiddenPointFilterEvents {
  /** Another answer is drawn: how many points are visible, and how long it took to get. */
  change: { count: number; milliseconds: number };
  /**
   * What a view or the points were refused for: told once until there is an answer again.
   * Without a listener, it is an unhandled rejection.
   */
  error: { error: Error };
}

/**
 * Draws only those of a `THREE.Points`' points that can be seen from the camera, and lets
 * rays pick no others: it replaces the geometry's index and draw range, until it is
 * disposed of. Points that neither of them drew before take no part. Attributes, materials
 * and the user's own index stay untouched.
 *
 * ```js
 * const filter = new HiddenPointFilter(points);
 * renderer.setAnimationLoop(() => {
 *   filter.update(camera);
 *   renderer.render(scene, camera);
 * });
 * ```
 *
 * The camera is taken into the points' own space, in whose units a radius is given. So
 * moving either of them is a new view; turning a perspective camera or changing its
 * field of view is not. An orthographic camera sees along a direction
 * (`visibleFromDirection`): only turning it is a new view.
 *
 * Positions whose attribute's version has grown (`needsUpdate = true`), other attributes,
 * indices, draw ranges and geometries are noticed by `update` and taken up as they are.
 *
 * Morph targets, instances and a scale that is not uniform are refused (`option`).
 */
export class HiddenPointFilter extends Reporter<HiddenPointFilterEvents> {
  /** While true, nothing new is asked, wherever the camera goes; an answer on its way is still drawn. */
  frozen = false;
  readonly #readiness = new Readiness();
  /**
   * Resolves when the points are prepared and, if `update` was called by then, the first
   * answer is drawn. Rejects with what the points or that view are refused for.
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
  /** Whether the points are to be taken up before anything else. */
  #isStale = true;
  #disposed = false;

  /**
   * @param points whose index and draw range are the filter's from now on.
   * @throws HprError `option`, `positions-type`, `too-large`. What takes the core to tell
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

  /** How many points are drawn, dimmed ones not counted: all of them until there is an answer. */
  get visibleCount(): number {
    return this.#display.count;
  }

  /**
   * To be called each frame, before rendering: asks for an answer if the view is a new one,
   * and draws it when it comes (at once with `worker: false`). Views that come while one is
   * being answered are left out but for the last.
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
   * Draws everything again: index, draw range and children are as they were. Also gives the
   * cloud's memory back. May be called twice.
   */
  dispose(): void {
    if (this.#disposed) {
      return;
    }
    this.#disposed = true;
    this.#follower.stop();
    this.#display.dispose();
    this.#dropCloud();
    // The caller of dispose() knows.
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

  /** Takes the points up as they are. */
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
        // A view that comes in the same breath counts.
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
      // Another view may do better.
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
