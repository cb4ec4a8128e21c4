import type { Points } from "three";

import { HprError } from "../base/errors.js";
import type { Round } from "../follow/follower.js";
import type { Cloud } from "../worker/followed-cloud.js";
import { CameraFilter, type FilterChange } from "./camera-filter.js";
import { requireUniformScale } from "./cameras.js";
import { prepareCloud } from "./cloud.js";
import { Display } from "./display.js";
import { requireUnfiltered } from "./drawn-points.js";
import { patchMaterial, type PatchMaterial } from "./map-material.js";
import { type HiddenPointFilterOptions, requireCloud, requirePoints } from "./options.js";

/** The events of a filter. */
export interface HiddenPointFilterEvents {
  /** A new answer for a camera is drawn. */
  change: FilterChange;
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
 * In motion, a map of directions is drawn (see `stale`), and at rest the answer of the option `settle`. Several cameras may look at the points: call `update` with each of them, before its
 * picture is rendered. Each has its own answers of one cloud.
 *
 * `update` notices changes and uses the new state: positions with a new version (`needsUpdate =
 * true`), other attributes, indices, draw ranges and geometries.
 *
 * Morph targets, instances and a non-uniform scale are refused (`option`).
 */
export class HiddenPointFilter extends CameraFilter<HiddenPointFilterEvents> {
  /** @internal */
  protected override readonly drawing: Display;
  /** Whether the points must be read before anything else. @internal */
  protected override isStale = true;
  #cloud: Cloud | undefined;
  /** The count of the last answer. */
  #count = 0;

  /**
   * Hides the points that the camera of `update` does not see.
   *
   * @param points the points. From now on, the filter owns their index and draw range.
   * @throws HprError `option`, `positions-type`, `too-large`. Errors that only the core can find
   *   (`non-finite`, the range of an option) may reject `ready` instead.
   */
  constructor(points: Points, options?: HiddenPointFilterOptions) {
    requirePoints(points);
    super(points, options, ["cloud", "origin"]);
    requireUnfiltered(points.geometry);
    requireUniformScale(points);
    this.settings.patch = this.patch;
    this.drawing = new Display(points, this.settings);
    try {
      this.follower.follow(true);
    } catch (error) {
      this.drawing.dispose();
      throw error;
    }
  }

  /**
   * The indices of the points that are drawn, without the dimmed ones: a copy, in the order of drawing. Each is there
   * once, also if the geometry's own index repeats it. While a map is drawn, each call tests all points against it.
   */
  get visible(): Uint32Array {
    return this.drawing.drawnIndices;
  }

  /** The length of `visible`. Before the first answer, this is all points. */
  get visibleCount(): number {
    return this.drawing.count;
  }

  /**
   * Whether a point is drawn, and not dimmed.
   *
   * @param index its number in the attribute `position`.
   * @throws HprError `option` if there is no such point.
   */
  isVisible(index: number): boolean {
    return this.drawing.isVisible(index);
  }

  /** How materials are made to leave out hidden points. @internal */
  protected get patch(): PatchMaterial {
    return patchMaterial;
  }

  /** @internal */
  protected override get cloud(): Cloud | undefined {
    return this.isStale ? undefined : this.#cloud;
  }

  /** @internal */
  protected override get isEmpty(): boolean {
    return this.#cloud === undefined;
  }

  /** @internal */
  protected override next(): Round | undefined {
    if (this.isStale) return this.#preparing();
    const camera = this.#cloud && this.enabled ? this.cameras.due(this.frozen) : undefined;
    // Points that were refused may have changed meanwhile.
    if (camera === undefined) return this.drawing.drawn.isUnchanged ? undefined : this.#preparing();
    /** An answer about other points is left, one about former positions is drawn. No later frame may come that asks again. */
    const isLeft = () => {
      const { isSame, isUnchanged } = this.drawing.drawn;
      const isOther = this.isStale || !isSame;
      this.isStale ||= !isUnchanged;
      return isOther;
    };
    return this.view(
      this.#cloud!,
      camera,
      (answer) => {
        if (isLeft()) return undefined;
        const count = this.drawing.answer(camera, answer.indices);
        this.#count = count;
        return { count };
      },
      (map) => {
        if (isLeft()) return undefined;
        this.drawing.map(camera, map, translation(this.settings.origin));
        return { count: this.#count };
      },
    );
  }

  /** @internal */
  protected override noticeChanges(): boolean {
    const { isUnchanged } = this.drawing.drawn;
    if (this.follower.isBusy || this.follower.isLost) {
      // The answer on its way may be about other points.
      this.drawing.leaveOthers();
    } else if (!isUnchanged) {
      this.isStale = true;
    }
    return !isUnchanged;
  }

  /** @internal */
  protected override leave(): void {
    // Nothing but the drawing belongs to a camera.
  }

  /** @internal */
  protected override dropCloud(): void {
    if (this.#isOwn) void this.#cloud?.dispose();
    this.#cloud = undefined;
    this.isStale = true;
  }

  /** Reads the points as they are now. */
  #preparing(): Round<Cloud> {
    return {
      ask: () => {
        this.dropCloud();
        this.isStale = false;
        this.drawing.leaveOthers();
        const { numbers, own } = this.drawing.drawn.take();
        const { cloud } = this.settings;
        if (cloud === undefined) return prepareCloud(numbers, own, this.settings);
        const points = numbers.length / 3;
        if (typeof cloud === "object") return withLength(cloud, points);
        return Promise.resolve(cloud()).then((made) => withLength(requireCloud(made), points));
      },
      use: (cloud) => {
        this.#cloud = cloud;
        this.#count = cloud.length;
        this.cameras.again(cloud.length, cloud.spacing);
        // If `update` is called in the same task, `ready` waits for the answer.
        queueMicrotask(() => {
          if (!this.follower.isBusy) this.readiness.resolve();
        });
        return () => this.tell();
      },
      leave: (cloud) => {
        if (this.#isOwn) void cloud.dispose();
      },
    };
  }

  /** Whether the cloud ends with the filter. */
  get #isOwn(): boolean {
    return typeof this.settings.cloud !== "object";
  }
}

/** The matrix from the points' space to the cloud. */
function translation(origin: readonly number[] | undefined): number[] | undefined {
  return origin && [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, ...origin, 1];
}

function withLength(cloud: Cloud, points: number): Cloud {
  if (cloud.length !== points) {
    throw new HprError("option", `cloud must have the ${points} points that the geometry draws, got ${cloud.length}`);
  }
  return cloud;
}
