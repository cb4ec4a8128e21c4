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
import { type Positions, readPositions, readViewpoint } from "./positions.js";
import { type ChosenRadius, type Visibility, VisibilityAnswer } from "./visibility.js";

/**
 * A point cloud in the memory of the wasm: prepared once, then asked from as
 * many viewpoints as needed.
 *
 * Its memory is given back by {@link PointCloud.dispose}, at the end of a `using`
 * block, or some time after it has become unreachable.
 */
export class PointCloud {
  /** The same as {@link PointCloud.dispose}, on platforms that have `Symbol.dispose`. */
  declare readonly [Symbol.dispose]: () => void;

  readonly #instance: Instance;
  readonly #length: number;
  readonly #skipped: number;
  #handle: number | undefined;

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
    const numbers = readPositions(positions, settings.stride);
    const { handle, length, skipped } = this.#instance.call((bindings) =>
      numbers.BYTES_PER_ELEMENT === 4
        ? bindings.createCloudF32(numbers as Float32Array, settings)
        : bindings.createCloudF64(numbers as Float64Array, settings),
    );
    this.#handle = handle;
    this.#length = length;
    this.#skipped = skipped;
    unreachable.register(this, { instance: this.#instance, handle }, this);
  }

  /** How many points were given, skipped ones included; also the length of a mask. */
  get length(): number {
    return this.#length;
  }

  /** How many points are left out because a coordinate is not finite. */
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
