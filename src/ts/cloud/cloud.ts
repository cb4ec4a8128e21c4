/// <reference lib="esnext.disposable" preserve="true" />
import type { ChosenRadius } from "../query/answers.js";
import { CoreCloud } from "./core-cloud.js";
import { addDisposeSymbol } from "../base/dispose-symbol.js";
import { requireInstance } from "../instance/instance.js";
import { CLOUD_OPTIONS, cloudSettings, givenOptions, pick, type PointCloudOptions } from "../query/options.js";
import type { Positions } from "../query/positions.js";
import {
  directionQuery,
  ILLUMINATION_OPTIONS,
  type IlluminationOptions,
  illuminationQuery,
  radiusQuery,
  RECONSTRUCTION_OPTIONS,
  type ReconstructionOptions,
  reconstructionQuery,
  severalQuery,
  viewQuery,
} from "../query/queries.js";
import { type RadiusRule, VIEW_OPTIONS, type VisibilityOptions } from "../query/view-options.js";
import { type Reconstruction, ReconstructionAnswer, type Visibility, VisibilityAnswer } from "./visibility.js";

/**
 * A point cloud in the memory of the wasm: prepared once, then asked from as
 * many viewpoints as needed. Points can be appended and removed; answers and
 * automatic radii are then, to the bit, those of a cloud built from the points
 * that are there.
 *
 * Its memory is given back by {@link PointCloud.dispose}, at the end of a `using`
 * block, or some time after it has become unreachable.
 */
export class PointCloud {
  /** The same as {@link PointCloud.dispose}, on platforms that have `Symbol.dispose`. */
  declare readonly [Symbol.dispose]: () => void;

  readonly #core: CoreCloud;

  static {
    addDisposeSymbol(this.prototype);
  }

  /**
   * Copies and prepares positions, in any units: O(n log n) for n points.
   *
   * @param positions the coordinates of one point after another: x, y, z unless
   *   `dimension` says otherwise. A Float32Array stays in single precision (up to three
   *   dimensions); everything else is read in double precision.
   * @throws HprError `not-initialised`, `option`, `positions-type`,
   *   `positions-length`, `non-finite`, `too-large`, `internal`.
   */
  constructor(positions: Positions, options?: PointCloudOptions) {
    const instance = requireInstance();
    const settings = cloudSettings(givenOptions(options, CLOUD_OPTIONS));
    this.#core = new CoreCloud(instance, positions, settings);
  }

  /**
   * How many points were ever given, skipped and removed ones included: the next
   * index, and the length of a mask.
   */
  get length(): number {
    return this.#core.size.length;
  }

  /** How many of the points given are left out because a coordinate is not finite. */
  get skipped(): number {
    return this.#core.size.skipped;
  }

  /**
   * The mean distance of a point to its 6 nearest others, in the cloud's units: what the
   * automatic rules go by. Measured at 2048 distinct points (512 beyond three dimensions)
   * where there are more; 0 where there are fewer than two.
   */
  get spacing(): number {
    return this.#core.size.spacing;
  }

  /**
   * Which points can be seen from a viewpoint, which may lie outside the cloud
   * or inside it: the hidden-point-removal operator of the paper (§3, algorithm 1).
   * A point is visible exactly when its flipped image is on the outer boundary of
   * the convex hull of all flipped images and the viewpoint.
   *
   * @param viewpoint x, y, z (as many as the cloud has dimensions) in the cloud's units.
   * @throws HprError `viewpoint`, `option`, `radius`, `too-large`, `disposed`, `internal`.
   */
  visibleFrom(viewpoint: ArrayLike<number>, options?: VisibilityOptions): Visibility {
    this.#core.requireOpen();
    const given = givenOptions(options, VIEW_OPTIONS);
    return new VisibilityAnswer(this.#core.ask(viewQuery(this.#core.dimension, viewpoint, given)));
  }

  /**
   * Which points can be seen along a direction, the way an orthographic camera looks: the
   * limit of viewpoints that recede to infinity against it, R = a·r² at distance r.
   * Exactly: the lower boundary of the convex hull of all (x, y, z + a·(x² + y²)), z being
   * the depth along the direction.
   *
   * a is 5 ÷ the cloud's spacing by default, 1/2c with `inversion: { exponential: c }`, and
   * R/d² for a given `radius` or `exponent`, measured from where the centroid is one
   * diagonal d of the bounding box ahead. The answer's `radius` is R for that viewpoint.
   * `"search"`, `"opposite"` and `power` have no limit and are refused (`option`).
   *
   * @param direction x, y, z, not zero, of any length. Needs a cloud of dimension 3.
   * @throws HprError `viewpoint` for the direction, otherwise as {@link PointCloud.visibleFrom}.
   */
  visibleFromDirection(direction: ArrayLike<number>, options?: VisibilityOptions): Visibility {
    this.#core.requireOpen();
    const given = givenOptions(options, VIEW_OPTIONS);
    return new VisibilityAnswer(this.#core.ask(directionQuery(this.#core.dimension, direction, given)));
  }

  /**
   * Which points can be seen from one of several viewpoints (paper, §5: viewpoints added
   * around the first help at silhouettes). Each view chooses its own R; the answer tells
   * the largest, and the hulls that all choices took. No viewpoint sees nothing.
   *
   * @throws HprError as {@link PointCloud.visibleFrom}.
   */
  visibleFromAny(viewpoints: readonly ArrayLike<number>[], options?: VisibilityOptions): Visibility {
    this.#core.requireOpen();
    const given = givenOptions(options, VIEW_OPTIONS);
    return new VisibilityAnswer(this.#core.ask(severalQuery(this.#core.dimension, viewpoints, given)));
  }

  /**
   * Which points can be seen from at least `k` of several viewpoints. Two of a small ring
   * (see `ringOfViewpoints`) and its middle find silhouettes, too, but no hidden planes.
   *
   * @param k from 1 to the number of viewpoints.
   * @throws HprError as {@link PointCloud.visibleFrom}.
   */
  visibleFromAtLeast(k: number, viewpoints: readonly ArrayLike<number>[], options?: VisibilityOptions): Visibility {
    this.#core.requireOpen();
    const given = givenOptions(options, VIEW_OPTIONS);
    return new VisibilityAnswer(this.#core.ask(severalQuery(this.#core.dimension, viewpoints, given, { k })));
  }

  /**
   * The radius that a rule (by default `"auto"`) chooses for a viewpoint, without asking
   * what is visible.
   *
   * @param viewpoint x, y, z in the cloud's units.
   * @throws HprError `viewpoint`, `option`, `radius`, `too-large`, `disposed`, `internal`.
   */
  autoRadius(viewpoint: ArrayLike<number>, rule?: RadiusRule): ChosenRadius {
    this.#core.requireOpen();
    return this.#core.ask(radiusQuery(this.#core.dimension, viewpoint, rule));
  }

  /**
   * The surface that a viewpoint sees, as far as points tell (paper, §5): the triangles of
   * the very hull that visibility is found with, corners back in their places. Triangles
   * with an edge longer than `maxEdge` are left out, and those at the viewpoint.
   *
   * @param viewpoint x, y, z in the cloud's units. Needs a cloud of dimension 3.
   * @throws HprError as {@link PointCloud.visibleFrom}.
   */
  reconstruct(viewpoint: ArrayLike<number>, options?: ReconstructionOptions): Reconstruction {
    this.#core.requireOpen();
    const given = givenOptions(options, RECONSTRUCTION_OPTIONS);
    return new ReconstructionAnswer(this.#core.ask(reconstructionQuery(this.#core.dimension, viewpoint, given)));
  }

  /**
   * Light and shadow (paper, §5): for every index ambient + (1 − ambient)·(lights that see
   * it ÷ lights), softened `smoothing` times. Skipped and removed points are not lit;
   * without lights all is ambient.
   *
   * @param lights the places of point lights, x, y, z each. Needs a cloud of dimension 3.
   * @returns one number from 0 to 1 for each index: the caller's own copy.
   * @throws HprError as {@link PointCloud.visibleFrom}.
   */
  illuminate(lights: readonly ArrayLike<number>[], options?: IlluminationOptions): Float32Array {
    this.#core.requireOpen();
    const given = givenOptions(options, ILLUMINATION_OPTIONS);
    return this.#core.ask(illuminationQuery(this.#core.dimension, lights, given)).brightness;
  }

  /**
   * Adds points, which take the next indices: all of them, or none and an error.
   * For m points to n: O(n + m log m), except that the whole cloud is sorted again
   * where they extend its bounding box beyond a power of two (or a multiple of it).
   *
   * @param positions coordinates of one point after another, in the cloud's units and with
   *   the `dimension`, `stride` and `nonFinite` the cloud was made with. Double precision
   *   appended to single precision makes the whole cloud one of double precision.
   * @throws HprError `positions-type`, `positions-length`, `non-finite`,
   *   `too-large`, `disposed`, `internal`; the cloud is unchanged then.
   */
  append(positions: Positions): void {
    this.#core.append(positions);
  }

  /**
   * Removes points: they are never visible again and hide nothing, and their
   * indices are never given again. What was removed before is ignored. Of several
   * equal points the others stay. One pass over the cloud.
   *
   * @param indices of points, in any order; removed all together, or none and an error.
   * @throws HprError `option` for what is not the index of a point, `too-large`,
   *   `disposed`, `internal`; the cloud is unchanged then.
   */
  remove(indices: ArrayLike<number>): void {
    this.#core.remove(indices);
  }

  /**
   * Gives the memory of an answer's `indices`, which are gone then, to answers to come: for
   * a viewpoint that moves, so that no memory is left to the garbage collector. `indices`
   * may then be the start of a longer buffer. Does nothing with an answer whose indices
   * are gone already.
   *
   * @throws HprError `option` for what is no answer of a cloud.
   */
  recycle(answer: Visibility): void {
    this.#core.keepMemory(VisibilityAnswer.takeMemory(answer));
  }

  /** Gives the cloud's memory back. Answers already given stay valid. May be called twice. */
  dispose(): void {
    this.#core.dispose();
  }
}

/**
 * The whole operation in one call: builds a cloud, asks it once and frees it.
 * For several viewpoints a {@link PointCloud} does the preparation only once.
 *
 * @param positions x, y, z of one point after another.
 * @param viewpoint x, y, z in the same units.
 * @throws HprError as the constructor of `PointCloud` and `PointCloud.visibleFrom`.
 */
export function hiddenPointRemoval(
  positions: Positions,
  viewpoint: ArrayLike<number>,
  options?: PointCloudOptions & VisibilityOptions,
): Visibility {
  const given = givenOptions(options, CLOUD_OPTIONS, VIEW_OPTIONS);
  const cloud = new PointCloud(positions, pick(given, CLOUD_OPTIONS));
  try {
    return cloud.visibleFrom(viewpoint, pick(given, VIEW_OPTIONS));
  } finally {
    cloud.dispose();
  }
}
