/// <reference lib="esnext.disposable" preserve="true" />
import { addDisposeSymbol } from "./dispose-symbol.js";
import { HprError } from "./errors.js";
import { type Instance, requireInstance } from "./instance.js";
import {
  checkRule,
  CLOUD_OPTIONS,
  cloudSettings,
  givenOptions,
  pick,
  type PointCloudOptions,
  VIEW_OPTIONS,
  viewSettings,
  type VisibilityOptions,
} from "./options.js";
import { packed, type Positions, readIndices, readPositions, readViewpoint } from "./positions.js";
import { type ChosenRadius, type Visibility, VisibilityAnswer } from "./visibility.js";

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

  readonly #instance: Instance;
  readonly #stride: number;
  #handle: number | undefined;
  #length: number;
  #skipped: number;

  static {
    addDisposeSymbol(this.prototype);
  }

  /**
   * Copies and prepares positions, in any units: O(n log n) for n points.
   *
   * @param positions x, y, z of one point after another. A Float32Array stays in
   *   single precision; an array of numbers is read in double precision.
   * @throws HprError `not-initialised`, `option`, `positions-type`,
   *   `positions-length`, `non-finite`, `too-large`, `internal`.
   */
  constructor(positions: Positions, options?: PointCloudOptions) {
    this.#instance = requireInstance();
    const settings = cloudSettings(givenOptions(options, CLOUD_OPTIONS));
    const numbers = packed(readPositions(positions, settings.stride), settings.stride);
    const { handle, length, skipped } = this.#instance.call((bindings) =>
      numbers.BYTES_PER_ELEMENT === 4
        ? bindings.createCloudF32(numbers as Float32Array, settings)
        : bindings.createCloudF64(numbers as Float64Array, settings),
    );
    this.#stride = settings.stride;
    this.#handle = handle;
    this.#length = length;
    this.#skipped = skipped;
    unreachable.register(this, { instance: this.#instance, handle }, this);
  }

  /**
   * How many points were ever given, skipped and removed ones included: the next
   * index, and the length of a mask.
   */
  get length(): number {
    return this.#length;
  }

  /** How many of the points given are left out because a coordinate is not finite. */
  get skipped(): number {
    return this.#skipped;
  }

  /**
   * Which points can be seen from a viewpoint, which may lie outside the cloud
   * or inside it: the hidden-point-removal operator of the paper (§3, algorithm 1).
   * A point is visible exactly when its flipped image is on the outer boundary of
   * the convex hull of all flipped images and the viewpoint.
   *
   * @param viewpoint x, y, z in the cloud's units.
   * @throws HprError `viewpoint`, `option`, `radius`, `too-large`, `disposed`, `internal`.
   */
  visibleFrom(viewpoint: ArrayLike<number>, options?: VisibilityOptions): Visibility {
    this.#requireHandle();
    const [x, y, z] = readViewpoint(viewpoint);
    const settings = viewSettings(givenOptions(options, VIEW_OPTIONS));
    // Asked again: getters of the arguments may have disposed of the cloud.
    const handle = this.#requireHandle();
    const answer = this.#instance.call((bindings) => bindings.visibleFrom(handle, x, y, z, settings));
    return new VisibilityAnswer(answer, this.#length);
  }

  /**
   * The radius that {@link PointCloud.visibleFrom} chooses for a viewpoint by itself.
   *
   * @param viewpoint x, y, z in the cloud's units.
   * @throws HprError `viewpoint`, `option`, `radius`, `disposed`, `internal`.
   */
  autoRadius(viewpoint: ArrayLike<number>, rule?: "auto"): ChosenRadius {
    this.#requireHandle();
    const [x, y, z] = readViewpoint(viewpoint);
    checkRule(rule);
    const handle = this.#requireHandle();
    return this.#instance.call((bindings) => bindings.autoRadius(handle, x, y, z));
  }

  /**
   * Adds points, which take the next indices: all of them, or none and an error.
   * For m points to n: O(n + m log m), except that the whole cloud is sorted again
   * where they extend its bounding box beyond a power of two (or a multiple of it).
   *
   * @param positions x, y, z of one point after another, in the cloud's units and
   *   with the `stride` and `nonFinite` the cloud was made with. Double precision
   *   appended to single precision makes the whole cloud one of double precision.
   * @throws HprError `positions-type`, `positions-length`, `non-finite`,
   *   `too-large`, `disposed`, `internal`; the cloud is unchanged then.
   */
  append(positions: Positions): void {
    this.#requireHandle();
    const numbers = packed(readPositions(positions, this.#stride), this.#stride);
    const handle = this.#requireHandle();
    const { length, skipped } = this.#instance.call((bindings) =>
      numbers.BYTES_PER_ELEMENT === 4
        ? bindings.appendF32(handle, numbers as Float32Array)
        : bindings.appendF64(handle, numbers as Float64Array),
    );
    this.#length = length;
    this.#skipped = skipped;
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
    this.#requireHandle();
    const integers = readIndices(indices);
    const handle = this.#requireHandle();
    this.#instance.call((bindings) => {
      bindings.remove(handle, integers);
    });
  }

  /** Gives the cloud's memory back. Answers already given stay valid. May be called twice. */
  dispose(): void {
    const handle = this.#handle;
    if (handle !== undefined) {
      this.#handle = undefined;
      unreachable.unregister(this);
      freeCloud({ instance: this.#instance, handle });
    }
  }

  #requireHandle(): number {
    if (this.#handle === undefined) {
      throw new HprError("disposed", "this cloud has been disposed of");
    }
    return this.#handle;
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

/** Clouds that were never disposed of, freed once nothing refers to them any more. */
const unreachable = new FinalizationRegistry(freeCloud);

/** A lost instance took its clouds along, and their numbers may be in use again. */
function freeCloud({ instance, handle }: { instance: Instance; handle: number }): void {
  if (instance.alive) {
    instance.call((bindings) => {
      bindings.freeCloud(handle);
    });
  }
}
