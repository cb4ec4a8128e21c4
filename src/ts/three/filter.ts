import type { Camera, Points } from "three";

import { HprError } from "../errors.js";
import type { Visibility } from "../visibility.js";
import { boxOf, extentOf } from "./box.js";
import { type Cloud, prepareCloud } from "./cloud.js";
import { Display } from "./display.js";
import { type DrawnPoints, requireUnfiltered } from "./drawn-points.js";
import { Eye, requireUniformScale } from "./eye.js";
import { type FilterSettings, type HiddenPointFilterOptions, readFilterOptions, requirePoints } from "./options.js";
import { Readiness } from "./readiness.js";
import { Recovery } from "./recovery.js";
import { asError, Reporter } from "./reporter.js";

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
  readonly #recovery = new Recovery(() => {
    this.#prepareAgain();
  });
  #cloud: Cloud | undefined;
  /** A cloud or an answer is awaited; nothing else is asked for meanwhile. */
  #busy = false;
  /** Something was refused, and nothing has been answered since. */
  #refused = false;
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
      this.#prepare();
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
      this.#refuse(error);
      return;
    }
    this.#keepUp();
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
    this.#display.dispose();
    this.#dropCloud();
    this.#recovery.stop();
    // Who has disposed of it knows.
    this.#readiness.reject(new HprError("disposed", "this filter has been disposed of"), true);
  }

  /** Takes the points up as they are, and asks for the view if there is one. */
  #prepare(): void {
    const read = this.#drawn.take();
    this.#eye.extent = extentOf([boxOf(read.numbers)]);
    this.#eye.forget();
    this.#dropCloud();
    this.#await(prepareCloud(read, this.#settings), (cloud) => {
      if (this.#disposed) {
        void cloud.dispose();
        return;
      }
      this.#cloud = cloud;
      if (this.#wantsAnswer()) {
        this.#ask();
        return;
      }
      // A view that comes in the same breath counts.
      queueMicrotask(() => {
        if (!this.#busy) {
          this.#readiness.resolve();
        }
      });
    });
  }

  #keepUp(): void {
    const { isUnchanged } = this.#drawn;
    if (this.#busy || this.#recovery.isLost) {
      // What is awaited may be about others.
      this.#display.leaveOthers();
      this.#recovery.wish(this.#eye.isNew || !isUnchanged);
    } else if (!isUnchanged) {
      this.#prepareAgain();
    } else if (this.#wantsAnswer()) {
      this.#ask();
    }
  }

  #prepareAgain(): void {
    this.#display.leaveOthers();
    try {
      this.#prepare();
    } catch (error) {
      this.#refuse(error);
    }
  }

  #wantsAnswer(): boolean {
    return this.#cloud !== undefined && this.enabled && !this.frozen && this.#eye.isNew;
  }

  #ask(): void {
    const begun = performance.now();
    const { isDirection } = this.#eye;
    const from = this.#eye.ask();
    const { view } = this.#settings;
    let asked: Visibility | Promise<Visibility>;
    try {
      asked = isDirection ? this.#cloud!.visibleFromDirection(from, view) : this.#cloud!.visibleFrom(from, view);
    } catch (error) {
      this.#refuse(error);
      return;
    }
    this.#await(asked, (answer) => {
      this.#apply(answer, begun);
    });
  }

  #apply(answer: Visibility, begun: number): void {
    if (this.#disposed || !this.#drawn.isSame) {
      return;
    }
    try {
      this.#display.answer(answer.indices, this.#settings.inWorker);
      this.#cloud?.recycle(answer);
    } catch (error) {
      this.#refuse(error);
      return;
    }
    this.#refused = false;
    this.#recovery.answered();
    this.#readiness.resolve();
    const milliseconds = performance.now() - begun;
    if (this.#wantsAnswer()) {
      this.#ask();
    }
    this.dispatchEvent({ type: "change", count: answer.count, milliseconds });
  }

  get #drawn(): DrawnPoints {
    return this.#display.drawn;
  }

  /** Goes on at once with what is there at once. */
  #await<T>(asked: T | Promise<T>, use: (value: T) => void): void {
    if (!(asked instanceof Promise)) {
      use(asked);
      return;
    }
    this.#busy = true;
    void asked.then(
      (value) => {
        this.#busy = false;
        use(value);
      },
      (error: unknown) => {
        this.#busy = false;
        this.#refuse(error);
        // Nobody may call update again where frames are drawn on demand.
        if (this.#wantsAnswer()) this.#ask();
      },
    );
  }

  #refuse(thrown: unknown): void {
    if (this.#disposed) {
      return;
    }
    const error = asError(thrown);
    if (this.#recovery.notices(error)) {
      this.#dropCloud();
      if (this.#recovery.isUnderWay) {
        return;
      }
      // Another view may do better.
      if (this.#eye.isNew) this.#eye.ask();
    }
    if (this.#refused) {
      return;
    }
    this.#refused = true;
    this.#readiness.reject(error, this.isHeard);
    this.dispatchEvent({ type: "error", error });
  }

  #dropCloud(): void {
    void this.#cloud?.dispose();
    this.#cloud = undefined;
  }
}
