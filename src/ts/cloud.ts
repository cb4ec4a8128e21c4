/// <reference lib="esnext.disposable" preserve="true" />
import { addDisposeSymbol } from "./dispose-symbol.js";
import { HprError } from "./errors.js";
import { type Instance, requireInstance } from "./instance.js";
import {
  CLOUD_OPTIONS,
  type CloudSettings,
  cloudSettings,
  type CloudSize,
  givenOptions,
  pick,
  type PointCloudOptions,
} from "./options.js";
import { perform } from "./perform.js";
import { packed, type Positions, readIndices, readPositions } from "./positions.js";
import {
  type Answers,
  directionQuery,
  ILLUMINATION_OPTIONS,
  type IlluminationOptions,
  illuminationQuery,
  type Query,
  type QueryKind,
  radiusQuery,
  RECONSTRUCTION_OPTIONS,
  type ReconstructionOptions,
  reconstructionQuery,
  severalQuery,
  viewQuery,
} from "./queries.js";
import { Spares } from "./spares.js";
import { type RadiusRule, VIEW_OPTIONS, type VisibilityOptions } from "./view-options.js";
import {
  type ChosenRadius,
  type Reconstruction,
  ReconstructionAnswer,
  takeMemory,
  type Visibility,
  VisibilityAnswer,
} from "./visibility.js";

/** A cloud whose building is followed: `progress` is told which share of it is done, and must not throw. */
export let build: (positions: Positions, options: PointCloudOptions, progress: (share: number) => void) => PointCloud;

/** Asks what was read before, maybe in another thread. */
export let ask: <K extends QueryKind>(cloud: PointCloud, query: Query<K>) => Answers[K];

/** Gives memory for the indices of answers to come. */
export let giveMemory: (cloud: PointCloud, buffer: ArrayBuffer | undefined) => void;

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
  readonly #settings: CloudSettings;
  #handle: number | undefined;
  #size: CloudSize;
  readonly #spares = new Spares();

  static #progress: ((share: number) => void) | undefined;

  static {
    addDisposeSymbol(this.prototype);
    build = (positions, options, progress) => {
      try {
        PointCloud.#progress = progress;
        return new PointCloud(positions, options);
      } finally {
        PointCloud.#progress = undefined;
      }
    };
    ask = (cloud, query) => cloud.#ask(query);
    giveMemory = (cloud, buffer) => {
      if (cloud.#handle !== undefined) {
        cloud.#spares.keep(buffer);
      }
    };
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
    this.#instance = requireInstance();
    const settings = cloudSettings(givenOptions(options, CLOUD_OPTIONS));
    const numbers = readPacked(positions, settings);
    const choices = { skipNonFinite: settings.skipNonFinite, progress: PointCloud.#progress };
    const { handle, ...size } = this.#instance.call((bindings) => {
      if (settings.dimension > 3) {
        return bindings.createHyperCloud(numbers as Float64Array, settings.dimension, choices);
      }
      return numbers.BYTES_PER_ELEMENT === 4
        ? bindings.createCloudF32(numbers as Float32Array, choices)
        : bindings.createCloudF64(numbers as Float64Array, choices);
    });
    this.#settings = settings;
    this.#handle = handle;
    this.#size = size;
    unreachable.register(this, { instance: this.#instance, handle }, this);
  }

  /**
   * How many points were ever given, skipped and removed ones included: the next
   * index, and the length of a mask.
   */
  get length(): number {
    return this.#size.length;
  }

  /** How many of the points given are left out because a coordinate is not finite. */
  get skipped(): number {
    return this.#size.skipped;
  }

  /**
   * The mean distance of a point to its 6 nearest others, in the cloud's units: what the
   * automatic rules go by. Measured at 2048 distinct points (512 beyond three dimensions)
   * where there are more; 0 where there are fewer than two.
   */
  get spacing(): number {
    return this.#size.spacing;
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
    this.#requireHandle();
    const given = givenOptions(options, VIEW_OPTIONS);
    return new VisibilityAnswer(this.#ask(viewQuery(this.#settings.dimension, viewpoint, given)));
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
    this.#requireHandle();
    const given = givenOptions(options, VIEW_OPTIONS);
    return new VisibilityAnswer(this.#ask(directionQuery(this.#settings.dimension, direction, given)));
  }

  /**
   * Which points can be seen from one of several viewpoints (paper, §5: viewpoints added
   * around the first help at silhouettes). Each view chooses its own R; the answer tells
   * the largest, and the hulls that all choices took. No viewpoint sees nothing.
   *
   * @throws HprError as {@link PointCloud.visibleFrom}.
   */
  visibleFromAny(viewpoints: readonly ArrayLike<number>[], options?: VisibilityOptions): Visibility {
    this.#requireHandle();
    const given = givenOptions(options, VIEW_OPTIONS);
    return new VisibilityAnswer(this.#ask(severalQuery(this.#settings.dimension, viewpoints, given)));
  }

  /**
   * Which points can be seen from at least `k` of several viewpoints. Two of a small ring
   * (see `ringOfViewpoints`) and its middle find silhouettes, too, but no hidden planes.
   *
   * @param k from 1 to the number of viewpoints.
   * @throws HprError as {@link PointCloud.visibleFrom}.
   */
  visibleFromAtLeast(k: number, viewpoints: readonly ArrayLike<number>[], options?: VisibilityOptions): Visibility {
    this.#requireHandle();
    const given = givenOptions(options, VIEW_OPTIONS);
    return new VisibilityAnswer(this.#ask(severalQuery(this.#settings.dimension, viewpoints, given, { k })));
  }

  /**
   * The radius that a rule (by default `"auto"`) chooses for a viewpoint, without asking
   * what is visible.
   *
   * @param viewpoint x, y, z in the cloud's units.
   * @throws HprError `viewpoint`, `option`, `radius`, `too-large`, `disposed`, `internal`.
   */
  autoRadius(viewpoint: ArrayLike<number>, rule?: RadiusRule): ChosenRadius {
    this.#requireHandle();
    return this.#ask(radiusQuery(this.#settings.dimension, viewpoint, rule));
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
    this.#requireHandle();
    const given = givenOptions(options, RECONSTRUCTION_OPTIONS);
    return new ReconstructionAnswer(this.#ask(reconstructionQuery(this.#settings.dimension, viewpoint, given)));
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
    this.#requireHandle();
    const given = givenOptions(options, ILLUMINATION_OPTIONS);
    return this.#ask(illuminationQuery(this.#settings.dimension, lights, given)).brightness;
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
    this.#requireHandle();
    const numbers = readPacked(positions, this.#settings);
    const handle = this.#requireHandle();
    this.#size = this.#instance.call((bindings) => {
      if (this.#settings.dimension > 3) {
        return bindings.appendHyper(handle, numbers as Float64Array);
      }
      return numbers.BYTES_PER_ELEMENT === 4
        ? bindings.appendF32(handle, numbers as Float32Array)
        : bindings.appendF64(handle, numbers as Float64Array);
    });
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
    this.#size = this.#instance.call((bindings) => bindings.remove(handle, integers));
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
    giveMemory(this, takeMemory(answer));
  }

  /** Gives the cloud's memory back. Answers already given stay valid. May be called twice. */
  dispose(): void {
    this.#spares.clear();
    const handle = this.#handle;
    if (handle !== undefined) {
      this.#handle = undefined;
      unreachable.unregister(this);
      freeCloud({ instance: this.#instance, handle });
    }
  }

  /** Getters of the arguments may have disposed of the cloud while they were read. */
  #ask<K extends QueryKind>(query: Query<K>): Answers[K] {
    const handle = this.#requireHandle();
    const { dimension } = this.#settings;
    const { length } = this.#size;
    return perform({ instance: this.#instance, handle, dimension, length, spares: this.#spares }, query);
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

function readPacked(positions: unknown, { stride, dimension }: CloudSettings): Float32Array | Float64Array {
  return packed(readPositions(positions, stride), stride, dimension);
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
