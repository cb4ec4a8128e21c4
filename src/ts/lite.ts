/// <reference lib="esnext.disposable" preserve="true" />
import { addDisposeSymbol, addTag } from "./base/objects.js";
import { describe, HprError } from "./base/errors.js";
import { HeldCloud, type OperatorBindings } from "./cloud/held-cloud.js";
import { type Visibility as FullVisibility, VisibilityAnswer } from "./cloud/visibility.js";
import { type Binary, compiledOnce, compileOwn, type InitInput, type SyncInitInput } from "./instance/compile.js";
import { type Engine, required } from "./instance/engine.js";
import { initFrom, startSync } from "./instance/start.js";
import * as glue from "./lite/hpr_bg.js";
import type { ChosenRadius } from "./query/queries.js";
import { VIEW_ROWS } from "./query/option-rows.js";
import {
  type Checked,
  CLOUD_OPTIONS,
  cloudSettings,
  givenOptions,
  pick,
  readOptions,
  type PointCloudOptions as FullCloudOptions,
} from "./query/options.js";
import { type Positions, readViewpoint, type Viewpoint } from "./query/positions.js";
import {
  chosenInversion,
  chosenRadius,
  type Inversion,
  NO_OPTIONS,
  resolvedInversion,
  ruleSettings,
  type ResolvedInversion as FullInversion,
} from "./query/view-options.js";

export { HprError, type HprErrorCode } from "./base/errors.js";
export type { NumberArray } from "./base/typed-arrays.js";
export type { InitInput, SyncInitInput, WasmModule } from "./instance/compile.js";
export type { ChosenRadius } from "./query/queries.js";
export type { Positions, Viewpoint } from "./query/positions.js";
export type { Inversion } from "./query/view-options.js";

/** The inversion of an answer, with numbers only. */
export type ResolvedInversion = Exclude<FullInversion, { readonly looks: unknown }>;

/** How the positions of a cloud are read. */
export interface PointCloudOptions extends FullCloudOptions {
  /** The number of coordinates of a point. Use 2 for clouds in a plane. Default 3. */
  dimension?: 2 | 3 | undefined;
}

/**
 * How one view is computed. At most one of `radius` and `exponent` may be given. With an inversion by
 * `power`, `radius` may be a number, but `exponent` is not allowed. With `exponential`, neither of the
 * two is allowed.
 */
export interface VisibilityOptions {
  /**
   * R, the radius of the sphere that points are flipped about, in the cloud's units. It is finite, and
   * at least the distance of the farthest point. `"auto"`, the default, is R = 0.4·n^¼·r²/g
   * (`docs/VISIBLE.md`).
   */
  radius?: number | "auto" | undefined;
  /** R = farthest distance · 10^exponent, the paper's own parameter. It is at least 0. */
  exponent?: number | undefined;
  /** How points are flipped. Default `"spherical"`. */
  inversion?: Inversion | ResolvedInversion | undefined;
}

/**
 * The points that are visible from a viewpoint. The masks are made from `indices` at each call, so a
 * change of `indices` changes them. After the buffer of `indices` was transferred away, the methods
 * throw an HprError `disposed`.
 */
export interface Visibility extends Omit<FullVisibility, "inversion" | "exact" | "scores"> {
  /**
   * How the points were flipped, with numbers only. With this inversion (and the radius, if it is not
   * exponential) as options, the points of any part of the cloud are flipped in the same way.
   */
  readonly inversion: ResolvedInversion;
  /** True: the answer is the final one. */
  readonly exact: true;
}

const { radius: RADIUS, exponent: EXPONENT, inversion: INVERSION } = VIEW_ROWS;
const ROWS = { radius: RADIUS, exponent: EXPONENT, inversion: INVERSION };
const MOST_DIMENSIONS = 3;

const binary: Binary = {
  file: "lite/hpr.wasm",
  wayOut:
    "Serve hpr_bg.wasm (the package exports it as hidden-point-removal/lite/hpr.wasm) and pass its address or its " +
    "bytes to init() (docs/BUNDLERS.md)",
};
const engine: Engine<OperatorBindings> = { state: {}, glue, binary };

// One literal expression, as in loader.ts.
const ownFile = compiledOnce(() => compileOwn(() => new URL("./lite/hpr_bg.wasm", import.meta.url), binary));

/**
 * Loads the small wasm of this entry and starts it: the file that comes with the package, or `input`.
 * Does nothing if it is running already. It may be called again after a failure, and after a trap
 * (`internal`).
 *
 * @throws HprError (as a rejection) `load` if it cannot be fetched, compiled or started.
 */
export function init(input?: InitInput): Promise<void> {
  return initFrom(engine, ownFile, input);
}

/**
 * Starts the wasm of this entry from its bytes or its compiled module, at once. Does nothing if it is
 * running already.
 *
 * @throws HprError `load` if it cannot be compiled or started.
 */
export function initSync(input: SyncInitInput): void {
  startSync(engine, input);
}

/**
 * A point cloud of two or three dimensions in the memory of the small wasm. Answers and radii are, to
 * the bit, those of the `PointCloud` of `hidden-point-removal`.
 *
 * {@link PointCloud.dispose} frees its memory, and so does the end of a `using` block. Otherwise the
 * memory is freed some time after the cloud has become unreachable.
 */
export class PointCloud {
  /** The same as {@link PointCloud.dispose}, on platforms that have `Symbol.dispose`. */
  declare readonly [Symbol.dispose]: () => void;

  readonly #cloud: HeldCloud<OperatorBindings>;

  static {
    addDisposeSymbol(this.prototype);
    addTag(this.prototype, "PointCloud");
  }

  /**
   * Copies and prepares positions, in any units. This takes O(n log n) for n points.
   *
   * @param positions the coordinates of one point after another. A Float32Array stays in single
   *   precision. Everything else is read in double precision.
   * @throws HprError `not-initialised`, `option`, `positions-type`, `positions-length`, `non-finite`,
   *   `too-large`, `internal`.
   */
  constructor(positions: Positions, options?: PointCloudOptions) {
    const instance = required(engine.state);
    const settings = cloudSettings(givenOptions(options, CLOUD_OPTIONS), MOST_DIMENSIONS);
    this.#cloud = new HeldCloud(instance, positions, settings);
  }

  /**
   * The number of all points ever given, with the skipped and the removed ones. This is also the next
   * index and the length of a mask.
   */
  get length(): number {
    return this.#cloud.size.length;
  }

  /** How many of the given points are left out because a coordinate is not finite. */
  get skipped(): number {
    return this.#cloud.size.skipped;
  }

  /**
   * Finds the points that can be seen from a viewpoint, outside or inside the cloud: the operator of
   * the paper (§3, algorithm 1).
   *
   * @param viewpoint x, y, z (x, y in a plane) in the cloud's units.
   * @throws HprError `viewpoint`, `option`, `radius`, `too-large`, `disposed`, `internal`. All options
   *   of the other entries are refused (`option`).
   */
  visibleFrom(viewpoint: Viewpoint, options?: VisibilityOptions): Visibility {
    this.#cloud.requireOpen();
    const given = readOptions(options, ROWS, this.#cloud.dimension) as Checked<VisibilityOptions, typeof ROWS>;
    const [x, y, z] = readViewpoint(viewpoint, this.#cloud.dimension) as [number, number, number];
    refuseOpposite("radius", given.radius);
    const settings = { ...NO_OPTIONS, ...chosenRadius(given), ...chosenInversion(given.inversion) };
    const { instance, handle } = this.#cloud.requireOpen();
    const answer = instance.call((bindings) => bindings.visibleFrom(handle, x, y, z, settings));
    const { indices, radius, exponent, evaluations, scales } = answer;
    const { length } = this;
    const inversion = resolvedInversion(settings, scales);
    const found = { indices, radius, exponent, evaluations, inversion, exact: true, length };
    return new VisibilityAnswer(found) as VisibilityAnswer & Visibility;
  }

  /**
   * The radius that `"auto"` chooses for a viewpoint. The visible points are not computed.
   *
   * @param viewpoint x, y, z (x, y in a plane) in the cloud's units.
   * @throws HprError `viewpoint`, `option`, `radius`, `too-large`, `disposed`, `internal`.
   */
  autoRadius(viewpoint: Viewpoint, rule?: "auto"): ChosenRadius {
    this.#cloud.requireOpen();
    const [x, y, z] = readViewpoint(viewpoint, this.#cloud.dimension) as [number, number, number];
    refuseOpposite("the rule", rule);
    // Refuses what is no rule at all.
    const settings = ruleSettings(rule);
    const { instance, handle } = this.#cloud.requireOpen();
    return instance.call((bindings) => bindings.autoRadius(handle, x, y, z, settings));
  }

  /**
   * Adds points, which take the next indices. After an error, none of them is added.
   *
   * @param positions the coordinates of one point after another, in the cloud's units. The cloud's
   *   `dimension`, `stride` and `nonFinite` apply.
   * @throws HprError `positions-type`, `positions-length`, `non-finite`, `too-large`, `disposed`,
   *   `internal`. Then the cloud is unchanged.
   */
  append(positions: Positions): void {
    this.#cloud.append(positions);
  }

  /**
   * Removes points. They are never visible again and hide nothing. Their indices are never used again.
   * Points that were removed before are ignored. Other points at the same position stay.
   *
   * @param indices indices of points, in any order. After an error, none of them is removed.
   * @throws HprError `option` for a value that is not the index of a point, `too-large`, `disposed`,
   *   `internal`. Then the cloud is unchanged.
   */
  remove(indices: ArrayLike<number>): void {
    this.#cloud.remove(indices);
  }

  /** Frees the cloud's memory. Earlier answers stay valid. May be called twice. */
  dispose(): void {
    this.#cloud.dispose();
  }
}

/**
 * The whole operation in one call. It builds a cloud, asks it once and frees it. For several
 * viewpoints, use a {@link PointCloud}: it does the preparation only once.
 *
 * @param positions x, y, z of one point after another.
 * @param viewpoint x, y, z in the same units.
 * @throws HprError the same as the constructor of `PointCloud` and as `PointCloud.visibleFrom`.
 */
export function hiddenPointRemoval(
  positions: Positions,
  viewpoint: Viewpoint,
  options?: PointCloudOptions & VisibilityOptions,
): Visibility {
  const given = givenOptions(options, CLOUD_OPTIONS, Object.keys(ROWS));
  const cloud = new PointCloud(positions, pick(given, CLOUD_OPTIONS));
  try {
    return cloud.visibleFrom(viewpoint, pick(given, Object.keys(ROWS)));
  } finally {
    cloud.dispose();
  }
}

/** Refuses the rule that asks for more than one hull. */
function refuseOpposite(name: string, rule: unknown): void {
  if (rule === "opposite") {
    throw new HprError("option", `${name} ${describe(rule)} needs the entry hidden-point-removal`);
  }
}
