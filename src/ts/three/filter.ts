import { type Camera, EventDispatcher, type EventListener, type Points } from "three";

import { HprError } from "../errors.js";
import type { Visibility } from "../visibility.js";
import { extentOf } from "./attribute.js";
import { type Cloud, prepareCloud } from "./cloud.js";
import { DimmedPoints } from "./dimmed.js";
import { DrawnPoints, requireUnfiltered } from "./drawn-points.js";
import { Eye, requireUniformScale } from "./eye.js";
import { type FilterSettings, type HiddenPointFilterOptions, readFilterOptions, requirePoints } from "./options.js";

/** What a filter tells its listeners. */
export interface HiddenPointFilterEvents {
  /** Another answer is drawn: how many points are visible, and how long it took to get. */
  change: { count: number; milliseconds: number };
  /** What a view or the points were refused for: told once until there is an answer again. */
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
export class HiddenPointFilter extends EventDispatcher<HiddenPointFilterEvents> {
  /** While true, nothing new is asked, wherever the camera goes; an answer on its way is still drawn. */
  frozen = false;
  /**
   * Resolves when the points are prepared and, if `update` was called by then, the first
   * answer is drawn. Rejects with what the points or that view are refused for.
   */
  readonly ready: Promise<void>;

  readonly #points: Points;
  readonly #settings: FilterSettings;
  readonly #eye = new Eye();
  readonly #drawn: DrawnPoints;
  readonly #dimmed: DimmedPoints | undefined;
  #settle!: { resolve: () => void; reject: (error: Error) => void };
  #settled = false;
  #cloud: Cloud | undefined;
  #enabled = true;
  /** A cloud or an answer is awaited; nothing else is asked for meanwhile. */
  #busy = false;
  #answered = false;
  /** Something was refused, and nothing has been answered since. */
  #refused = false;
  /** The worker was lost, and the next one has not answered yet. */
  #recovering = false;
  #disposed = false;
  #isHeard = false;

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
    const { dim, dimMaterial } = this.#settings;
    this.#dimmed = dim ? new DimmedPoints(points, dimMaterial) : undefined;
    this.#drawn = new DrawnPoints(points, dim);
    this.ready = new Promise((resolve, reject) => {
      this.#settle = { resolve, reject };
    });
    try {
      this.#prepare();
    } catch (error) {
      this.#drawn.release();
      throw error;
    }
  }

  /** While false, everything is drawn and nothing is asked. Default true. */
  get enabled(): boolean {
    return this.#enabled;
  }

  set enabled(enabled: boolean) {
    this.#enabled = enabled;
    if (enabled) {
      this.#show();
    } else {
      this.#showAll();
    }
  }

  /** How many points are drawn, dimmed ones not counted: all of them until there is an answer. */
  get visibleCount(): number {
    return this.#answered && this.#enabled ? this.#drawn.visible : this.#drawn.total;
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
    this.#dimmed?.follow();
    if (!this.#enabled || this.frozen) {
      return;
    }
    try {
      this.#eye.look(this.#points, camera);
    } catch (error) {
      this.#refuse(error);
      return;
    }
    this.#keepUp();
  }

  /** `"change"`: another answer is drawn. `"error"`: without a listener, it is an unhandled rejection. */
  override addEventListener<T extends keyof HiddenPointFilterEvents>(
    type: T,
    listener: EventListener<HiddenPointFilterEvents[T], T, this>,
  ): void {
    this.#isHeard ||= type === "error";
    super.addEventListener(type, listener);
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
    this.#dimmed?.dispose();
    this.#drawn.release();
    this.#dropCloud();
    // Who has disposed of it knows.
    this.ready.catch(() => undefined);
    this.#settle.reject(new HprError("disposed", "this filter has been disposed of"));
  }

  /** Takes the points up as they are, and asks for the view if there is one. */
  #prepare(): void {
    const read = this.#drawn.take();
    this.#eye.extent = extentOf(read.numbers);
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
          this.#resolve();
        }
      });
    });
  }

  #keepUp(): void {
    const drawn = this.#drawn;
    if (this.#busy) {
      if (!drawn.isSame) {
        // What is awaited is about other points.
        this.#showAll();
        drawn.release();
        this.#answered = false;
      }
      return;
    }
    if (!drawn.isUnchanged) {
      this.#prepareAgain();
    } else if (this.#wantsAnswer()) {
      this.#ask();
    }
  }

  #prepareAgain(): void {
    if (!this.#drawn.isSame) {
      this.#answered = false;
      this.#dimmed?.hide();
    }
    try {
      this.#prepare();
    } catch (error) {
      this.#refuse(error);
    }
  }

  #wantsAnswer(): boolean {
    return this.#cloud !== undefined && this.#enabled && !this.frozen && this.#eye.isNew;
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
      this.#drawn.setVisible(answer.indices);
      this.#cloud?.recycle(answer);
    } catch (error) {
      this.#refuse(error);
      return;
    }
    this.#answered = true;
    this.#refused = this.#recovering = false;
    this.#show();
    this.#resolve();
    const milliseconds = performance.now() - begun;
    if (this.#wantsAnswer()) {
      this.#ask();
    }
    this.dispatchEvent({ type: "change", count: answer.count, milliseconds });
  }

  #show(): void {
    if (this.#answered && this.#enabled && !this.#disposed) {
      this.#drawn.show();
      this.#dimmed?.show(this.#drawn);
    }
  }

  #showAll(): void {
    this.#drawn.showAll();
    this.#dimmed?.hide();
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
      },
    );
  }

  #refuse(thrown: unknown): void {
    if (this.#disposed) {
      return;
    }
    const error = thrown instanceof Error ? thrown : new Error(String(thrown));
    if (error instanceof HprError && error.code === "internal" && !this.#recovering) {
      this.#recovering = true;
      this.#prepareAgain();
      return;
    }
    if (this.#refused) {
      return;
    }
    this.#refused = true;
    this.#reject(error);
    this.dispatchEvent({ type: "error", error });
  }

  #resolve(): void {
    this.#settled = true;
    this.#settle.resolve();
  }

  /** What nobody listens to is reported as any other promise that nobody awaits. */
  #reject(error: Error): void {
    if (this.#isHeard) {
      this.ready.catch(() => undefined);
    } else if (this.#settled) {
      void Promise.reject(error);
    }
    this.#settled = true;
    this.#settle.reject(error);
  }

  #dropCloud(): void {
    void this.#cloud?.dispose();
    this.#cloud = undefined;
  }
}
