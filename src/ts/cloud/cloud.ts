/// <reference lib="esnext.disposable" preserve="true" />
import type { ChosenRadius, Found, Panorama } from "../query/queries.js";
import { HprError } from "../base/errors.js";
import { CoreCloud } from "./held-cloud.js";
import { addDisposeSymbol, addTag } from "../base/objects.js";
import { type MethodName, readQuestion } from "./methods.js";
import { requireInstance } from "../instance/instance.js";
import {
  CLOUD_OPTIONS,
  cloudSettings,
  givenOptions,
  readOptions,
  listener,
  pick,
  type PointCloudOptions,
} from "../query/options.js";
import type { Positions, Viewpoint } from "../query/positions.js";
import type { ImageCamera, ViewpointOrCamera } from "../query/camera.js";
import type {
  IlluminationOptions,
  PanoramaOptions,
  ReconstructionOptions,
  VisibilityMapOptions,
} from "../query/option-rows.js";
import type { Calibration, Station } from "../query/calibration.js";
import type { SurfaceKind } from "../query/option-types.js";
import {
  type CoverageOptions,
  type Placement,
  type PlacementOptions,
  type SeenBy,
  surveyed,
  surveyQuestion,
  type SurveyQuestion,
} from "../query/surveys.js";
import { type FollowedOptions, type RadiusRule, VIEW_OPTIONS, type VisibilityOptions } from "../query/view-options.js";
import type { CameraView, Reconstruction, ScoredIf, Visibility } from "./visibility.js";
import type { VisibilityMap } from "./visibility-map.js";

/**
 * A point cloud in the memory of the wasm. It is prepared once, and can then be asked from as many
 * viewpoints as needed. Points can be appended and removed. After that, answers and automatic radii
 * are the same, to the bit, as those of a cloud built from the remaining points.
 *
 * {@link PointCloud.dispose} frees its memory, and so does the end of a `using` block. Otherwise the
 * memory is freed some time after the cloud has become unreachable.
 */
export class PointCloud {
  /** The same as {@link PointCloud.dispose}, on platforms that have `Symbol.dispose`. */
  declare readonly [Symbol.dispose]: () => void;

  readonly #core: CoreCloud;

  static {
    addDisposeSymbol(this.prototype);
    addTag(this.prototype, "PointCloud");
  }

  /**
   * Copies and prepares positions, in any units. This takes O(n log n) for n points.
   *
   * @param positions the coordinates of one point after another: x, y, z, or another number of
   *   coordinates by the option `dimension`. A Float32Array stays in single precision (up to three
   *   dimensions). Everything else is read in double precision.
   * @throws HprError `not-initialised`, `option`, `positions-type`,
   *   `positions-length`, `non-finite`, `too-large`, `internal`.
   */
  constructor(positions: Positions, options?: PointCloudOptions) {
    const instance = requireInstance();
    const settings = cloudSettings(givenOptions(options, CLOUD_OPTIONS));
    this.#core = new CoreCloud(instance, positions, settings);
    surveyed.set(this, (question) => this.#survey(question));
  }

  /**
   * The number of all points ever given, with the skipped and the removed ones. This is also the next
   * index and the length of a mask.
   */
  get length(): number {
    return this.#core.size.length;
  }

  /** How many of the given points are left out because a coordinate is not finite. */
  get skipped(): number {
    return this.#core.size.skipped;
  }

  /**
   * The mean distance of a point to its 6 nearest neighbors, in the cloud's units. The automatic
   * scale c of `exponential` is a share of it. So are those of `looks`, unless the points leave much
   * of what they span empty. It is measured at 2048 distinct points (512 above three dimensions), or
   * at all points if there are fewer. It is 0 for fewer than two points.
   */
  get spacing(): number {
    return this.#core.size.spacing;
  }

  /**
   * How far measured points lie off their surface: one standard deviation, in the cloud's units. It is
   * measured at 2048 distinct points when it is read first, and again after a change. It is 0 where
   * nothing tells of noise: on clean surfaces, for fewer than 2048 distinct points, and above three
   * dimensions. `thickness` follows from it.
   *
   * @throws HprError `too-large`, `disposed`, `internal`.
   */
  get noise(): number {
    return this.#core.ask({ kind: "noise" }).noise;
  }

  /**
   * What the survey of the points found: `"clean"` for even samples of a surface, `"noisy"` where a sensor's noise is
   * everywhere, `"layered"` for registered scans. The looks follow it, unless the option `surface` says otherwise.
   *
   * @throws HprError `too-large`, `disposed`, `internal`.
   */
  get surface(): SurfaceKind {
    return this.#core.ask({ kind: "surface" }).surface;
  }

  /**
   * Finds the points that can be seen from a viewpoint. The viewpoint may lie outside the cloud or
   * inside it. This is the hidden-point-removal operator of the paper (§3, algorithm 1). A point is
   * visible exactly if its flipped image is on the outer boundary of the convex hull of all flipped
   * images and the viewpoint.
   *
   * @param viewpoint x, y, z (as many as the cloud has dimensions) in the cloud's units.
   * @throws HprError `viewpoint`, `option`, `radius`, `too-large`, `disposed`, `internal`.
   */
  visibleFrom<Scores extends boolean = false>(
    viewpoint: Viewpoint,
    options?: VisibilityOptions & { scores?: Scores | undefined },
  ): ScoredIf<Scores> {
    return this.#ask("visibleFrom", viewpoint, options) as ScoredIf<Scores>;
  }

  /**
   * Makes a map of directions: it tells which points are certainly hidden from a viewpoint, in a shader
   * or here. It takes a fixed number of points, however many the cloud has. It never hides a point
   * that {@link PointCloud.visibleFrom} shows with the same options; with `looks`, hardly any. It shows all visible points
   * and some hidden ones, and all points if the farthest one is nearer than 10⁻¹⁵ units or farther than 10¹⁵.
   *
   * @param viewpoint x, y, z in the cloud's units. Needs a cloud of dimension 3.
   * @throws HprError as {@link PointCloud.visibleFrom}.
   */
  visibilityMap(viewpoint: Viewpoint, options?: VisibilityMapOptions): VisibilityMap {
    return this.#ask("visibilityMap", viewpoint, options);
  }

  /**
   * Makes an image of what stands in each direction: the surface of the points that
   * {@link PointCloud.visibleFrom} shows with the same options. The image is equirectangular: the middle of
   * pixel (row, column) looks at the elevation 90° − 180°·(row + ½)/height and at the azimuth
   * 360°·column/width, from +x to up × x (for the usual up: to +y). So it is mirrored, as a map of the sky.
   * A triangle between visible points is surface if its edges, in local spacings, are at most 2.5 times as long as
   * those of nine in ten triangles that face the viewer, in space or by angle.
   *
   * @param viewpoint x, y, z in the cloud's units. Needs a cloud of dimension 3.
   * @returns arrays that are the caller's own; `skyViewFactor` and `solidAngle` do not depend on the
   *   size of the image.
   * @throws HprError `viewpoint` also for `up`, `option` also for `scores`, `too-large`;
   *   otherwise as {@link PointCloud.visibleFrom}.
   */
  panorama(viewpoint: Viewpoint, options: PanoramaOptions): Panorama {
    return this.#ask("panorama", viewpoint, options);
  }

  /**
   * Finds the points that can be seen along a direction, as an orthographic camera looks. The answer
   * is the limit of viewpoints ever farther back, where R = a·r² at the distance r. The visible points
   * are exactly those on the lower boundary of the convex hull of all (x, y, z + a·(x² + y²)). Here z
   * is the depth along the direction.
   *
   * By default, a is 0.4·n^¼/g, as the automatic R is 0.4·n^¼·r²/g. With `inversion: { exponential: c }`, a is 1/(2c). For a
   * given `radius` or `exponent`, a is R/d². Here d is the diagonal of the bounding box, and R is
   * measured from the viewpoint that lies at the distance d before the centroid. The answer's `radius`
   * is R for that viewpoint. `looks` have a limit, too (docs/LOOKS.md). `"opposite"` and `power` have no limit and are refused
   * (`option`).
   *
   * @param direction x, y, z, not zero, of any length. Needs a cloud of dimension 3.
   * @throws HprError `viewpoint` for the direction, otherwise the same as {@link PointCloud.visibleFrom}.
   */
  visibleFromDirection(direction: Viewpoint, options?: VisibilityOptions): Visibility {
    return this.#ask("visibleFromDirection", direction, options);
  }

  /**
   * Finds the points that can be seen from at least one of several viewpoints. Viewpoints added around
   * the first one help at silhouettes (paper, §5). Each view chooses its own R. The answer holds the
   * largest R, and the number of hulls that all choices took. Without viewpoints, nothing is visible.
   *
   * @throws HprError as {@link PointCloud.visibleFrom}.
   */
  visibleFromAny(viewpoints: readonly ViewpointOrCamera[], options?: VisibilityOptions): Visibility {
    return this.#ask("visibleFromAny", viewpoints, options);
  }

  /**
   * Finds the points that can be seen from at least `k` of several viewpoints. For silhouettes, use
   * `k` = 2 with a small ring of viewpoints (see `ringOfViewpoints`) and its middle. Unlike
   * `visibleFromAny`, this does not show hidden planes.
   *
   * @param k from 1 to the number of viewpoints.
   * @throws HprError as {@link PointCloud.visibleFrom}.
   */
  visibleFromAtLeast(k: number, viewpoints: readonly ViewpointOrCamera[], options?: VisibilityOptions): Visibility {
    return this.#ask("visibleFromAtLeast", k, viewpoints, options);
  }

  /**
   * Finds the points that a real camera sees, and where they are in its image. The answer is that of
   * `visibleFrom` from the camera's place, without the points outside of the image. These points still
   * hide others. A point at the camera's place is left out.
   *
   * @param camera its place, axes, lens and image; see `cameraFromPose`, `intrinsicsFromFieldOfView` and
   *   `cameraFromThree`. Needs a cloud of dimension 3.
   * @throws HprError `viewpoint` for the camera, otherwise as {@link PointCloud.visibleFrom}.
   */
  visibleFromCamera(camera: ImageCamera, options?: VisibilityOptions): CameraView {
    return this.#ask("visibleFromCamera", camera, options);
  }

  /**
   * Says for positions that are not in the cloud (labels, sensors, targets) whether a point there would
   * be visible, if it was added to the cloud, alone. The cloud stays as it is. The answer is exactly that
   * of a cloud with this one point more: an automatic radius is chosen for the cloud with the point.
   *
   * @param viewpoint x, y, z in the cloud's units.
   * @param positions the coordinates of one position after another. The cloud's `dimension`, `stride` and
   *   `nonFinite` apply. A position outside of `within` is not visible.
   * @returns one byte for each position: 1 visible, 0 hidden. The array is the caller's own copy.
   * @throws HprError `positions-type`, `positions-length`, `non-finite`; `radius` for a position beyond a
   *   given radius; `option` also for `scores`; otherwise as
   *   {@link PointCloud.visibleFrom}.
   */
  sees(viewpoint: Viewpoint, positions: Positions, options?: VisibilityOptions): Uint8Array {
    return this.#ask("sees", viewpoint, positions, options);
  }

  /**
   * Counts how many of the viewpoints see each index. A camera sees what is in its image. The memory does not grow with the number of
   * viewpoints.
   *
   * @returns one count for each index. The array is the caller's own copy.
   * @throws HprError `option` also for `scores`; otherwise as {@link PointCloud.visibleFrom}.
   */
  coverage(viewpoints: readonly ViewpointOrCamera[], options?: CoverageOptions): Uint32Array {
    return this.#survey(surveyQuestion("coverage", viewpoints, options));
  }

  /**
   * Which of many cameras see each point, and where in their images. A camera sees what `visibleFromCamera`
   * finds.
   *
   * @throws HprError `option` also for `scores`; `too-large`; otherwise as
   *   {@link PointCloud.visibleFromCamera}.
   */
  seenBy(cameras: readonly ImageCamera[], options?: CoverageOptions): SeenBy {
    return this.#survey(surveyQuestion("seenBy", cameras, options));
  }

  /**
   * Chooses viewpoints among candidates: always the one that adds most to what the others see, ties to
   * the lowest number. The choice ends at `count` viewpoints, when `share` is seen, or when nothing more is
   * gained. With `count`, it sees at least 1 − 1/e of what the best choice of so many sees.
   *
   * @throws HprError `option` also for `scores`; otherwise as {@link PointCloud.visibleFrom}.
   */
  placeViewpoints(candidates: readonly ViewpointOrCamera[], options?: PlacementOptions): Placement {
    return this.#survey(surveyQuestion("placeViewpoints", candidates, options));
  }

  /**
   * Finds the thickness of the looks at which scanners see most of the points that they measured, and few that are
   * hidden from them. This is for scans that were thinned or put together, where no other rule tells what is surface.
   * Thicknesses are tried from 0 upwards, from every station: up to twenty views each. A larger one is taken only if it
   * shows a larger share of own points than of hidden ones, and half a percent more for each doubling.
   *
   * @returns also the share of each station's own points that is seen, and of otherwise hidden points. With a number as
   *   `thickness`, only this one is tried.
   * @throws HprError `option` also for stations without points; otherwise as {@link PointCloud.visibleFrom}.
   */
  calibrate(stations: readonly Station[], options?: FollowedOptions): Calibration {
    return this.#ask("calibrate", stations, options);
  }

  /** Asks all views of a task, one after another. */
  #survey<Result>([method, options, rows, read]: SurveyQuestion<Result>): Result {
    this.#core.requireOpen();
    const given = readOptions(options, rows, this.#core.dimension);
    const progress = listener(given, "onProgress") as CoverageOptions["onProgress"];
    const task = read(this.#core.dimension, given, progress);
    const { size } = this.#core;
    try {
      for (let next = task.next(0); next !== undefined; next = task.next(0)) {
        const found: Found = this.#core.ask(next.view);
        task.take(next.number, found);
        if (this.#core.size !== size) {
          throw new HprError("option", `${method}: a callback must not change the cloud`);
        }
      }
      return task.result(this.length);
    } finally {
      task.end();
    }
  }

  /**
   * The radius that a rule (by default `"auto"`) chooses for a viewpoint. The visible points are not
   * computed.
   *
   * @param viewpoint x, y, z in the cloud's units.
   * @throws HprError `viewpoint`, `option`, `radius`, `too-large`, `disposed`, `internal`.
   */
  autoRadius(viewpoint: Viewpoint, rule?: RadiusRule): ChosenRadius {
    return this.#ask("autoRadius", viewpoint, rule);
  }

  /**
   * The surface that a viewpoint sees, as far as the points show it (paper, §5). It consists of
   * triangles of the same hull that decides visibility, with the corners back at their own places.
   * Triangles with an edge longer than `maxEdge` are left out, and so are triangles that touch the
   * viewpoint.
   *
   * @param viewpoint x, y, z in the cloud's units. Needs a cloud of dimension 3.
   * @throws HprError as {@link PointCloud.visibleFrom}.
   */
  reconstruct(viewpoint: Viewpoint, options?: ReconstructionOptions): Reconstruction {
    return this.#ask("reconstruct", viewpoint, options);
  }

  /**
   * Light and shadow (paper, §5). The brightness of each point is ambient + (1 − ambient)·s. Here s is
   * the share of the lights that see the point. Then the brightness is softened `smoothing` times.
   * Skipped and removed points are not lit. Without lights, every point has the brightness `ambient`.
   *
   * @param lights the places of point lights, x, y, z each. Needs a cloud of dimension 3.
   * @returns one number from 0 to 1 for each index. The array is the caller's own copy.
   * @throws HprError as {@link PointCloud.visibleFrom}.
   */
  illuminate(lights: readonly Viewpoint[], options?: IlluminationOptions): Float32Array {
    return this.#ask("illuminate", lights, options);
  }

  /**
   * Adds points, which take the next indices. After an error, none of them is added. Adding m points
   * to n takes O(n + m log m). But if they extend the bounding box beyond a power of two (or a
   * multiple of it), the whole cloud is sorted again.
   *
   * @param positions the coordinates of one point after another, in the cloud's units. The cloud's
   *   `dimension`, `stride` and `nonFinite` apply. If the cloud has single precision and these
   *   positions have double precision, the whole cloud changes to double precision.
   * @throws HprError `positions-type`, `positions-length`, `non-finite`,
   *   `too-large`, `disposed`, `internal`. Then the cloud is unchanged.
   */
  append(positions: Positions): void {
    this.#core.append(positions);
  }

  /**
   * Removes points. They are never visible again and hide nothing. Their indices are never used again.
   * Points that were removed before are ignored. Other points at the same position stay. This takes
   * one pass over the cloud.
   *
   * @param indices indices of points, in any order. After an error, none of them is removed.
   * @throws HprError `option` for a value that is not the index of a point, `too-large`,
   *   `disposed`, `internal`. Then the cloud is unchanged.
   */
  remove(indices: ArrayLike<number>): void {
    this.#core.remove(indices);
  }

  #ask<Name extends MethodName>(name: Name, ...args: readonly unknown[]): ReturnType<PointCloud[Name]> {
    this.#core.requireOpen();
    const { query, answer } = readQuestion(name, this.#core.settings, args);
    return answer(this.#core.ask(query) as never) as ReturnType<PointCloud[Name]>;
  }

  /** Frees the cloud's memory. Earlier answers stay valid. May be called twice. */
  dispose(): void {
    this.#core.dispose();
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
  const given = givenOptions(options, CLOUD_OPTIONS, VIEW_OPTIONS);
  const cloud = new PointCloud(positions, pick(given, CLOUD_OPTIONS));
  try {
    return cloud.visibleFrom(viewpoint, pick(given, VIEW_OPTIONS));
  } finally {
    cloud.dispose();
  }
}
