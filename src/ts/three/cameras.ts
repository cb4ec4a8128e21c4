import type { Camera, Matrix4, Object3D } from "three";

import { describe, HprError } from "../base/errors.js";
import { type FollowSettings, REST, type Stage, stagesFor } from "../follow/options.js";
import { FollowedView } from "../follow/view.js";
import { coneOf, type Place, readViewpoint, type Viewpoint } from "../query/positions.js";
import type { VisibilityOptions } from "../query/view-options.js";

/** One camera's view of a cloud, and how far its answers have come. */
export class FollowedCamera extends FollowedView {
  readonly camera: Camera;
  /** When its last question was asked. */
  askedAt = -Infinity;

  constructor(camera: Camera, wake: () => void) {
    super(wake);
    this.camera = camera;
  }

  /** Whether the view has moved a moment ago. */
  get isMoving(): boolean {
    return this.stillFor < REST;
  }
}

/** The number of cameras that are remembered. If there are more, the one that was not used for the longest time goes. */
const MOST = 8;

/** The cameras that look at one cloud, each with its own view and answers. */
export class FollowedCameras {
  readonly #settings: FollowSettings & { origin?: readonly number[] | undefined };
  readonly #wake: () => void;
  readonly #dropped: (camera: FollowedCamera) => void;
  readonly #drawsMaps: () => boolean;
  /** In the order of their last use. */
  readonly #cameras = new Map<Camera, FollowedCamera>();
  #points = 0;
  #spacing = 0;

  /**
   * `wake` is called when a question becomes due. `dropped` is called with a camera that is forgotten. `drawsMaps`
   * tells whether maps can be drawn.
   */
  constructor(
    settings: FollowSettings & { origin?: readonly number[] | undefined },
    wake: () => void,
    dropped: (camera: FollowedCamera) => void,
    drawsMaps: () => boolean,
  ) {
    this.#settings = settings;
    this.#wake = wake;
    this.#dropped = dropped;
    this.#drawsMaps = drawsMaps;
  }

  /** The camera that looked last. */
  get last(): FollowedCamera | undefined {
    return [...this.#cameras.values()].at(-1);
  }

  /** A camera, which is now the last one. */
  of(camera: Camera): FollowedCamera {
    requireCamera(camera);
    const followed = this.#cameras.get(camera) ?? this.#added(camera);
    if (this.#cameras.size > 1) {
      this.#cameras.delete(camera);
      this.#cameras.set(camera, followed);
    }
    return followed;
  }

  /** Reads the camera's place in the cloud, or takes the given one. Returns whether it has moved. */
  look(followed: FollowedCamera, object: Space, viewpoint?: Viewpoint): boolean {
    const { place, rounding } = viewpoint
      ? { place: { from: readViewpoint(viewpoint, 3), isDirection: false }, rounding: 0 }
      : placeOf(followed.camera, object, this.#settings.origin);
    if (!followed.move(place, this.#spacing, rounding)) return false;
    followed.moved(this.#stagesFor(followed));
    return true;
  }

  /** All cameras ask again, because the cloud has changed. */
  again(points = this.#points, spacing = this.#spacing): void {
    this.#points = points;
    this.#spacing = spacing;
    for (const followed of this.#cameras.values()) {
      const stages = this.#stagesFor(followed);
      // At rest, the exact answer comes at once: a map would only delay it.
      followed.begin(stages, stages[0]?.kind === "map" && !followed.isMoving ? 1 : 0);
    }
  }

  /**
   * All cameras ask again, because the options have changed. At rest, the final answer comes at once: an earlier one
   * would show points that the picture has no longer.
   */
  reconsider(): void {
    for (const followed of this.#cameras.values()) {
      const stages = this.#stagesFor(followed);
      const isShown = followed.drawn !== undefined && !followed.isMoving;
      followed.begin(stages, isShown ? stages.length - 1 : 0);
    }
  }

  /**
   * The camera whose question is due. Cameras take turns: the one that waits longest goes first. With `begunOnly`, views
   * that have no answer yet are left out.
   */
  due(begunOnly: boolean): FollowedCamera | undefined {
    let first: FollowedCamera | undefined;
    for (const followed of this.#cameras.values()) {
      const isLeftOut = followed.place === undefined || (begunOnly && !followed.isBegun);
      const isDue = !isLeftOut && followed.due !== undefined;
      if (isDue && (first === undefined || followed.askedAt < first.askedAt)) first = followed;
    }
    return first;
  }

  /** Whether the last question about each view was answered, or refused. */
  get areSettled(): boolean {
    return [...this.#cameras.values()].every(({ isSettled, place }) => isSettled || place === undefined);
  }

  stop(): void {
    for (const followed of this.#cameras.values()) followed.stop();
  }

  #stagesFor({ place }: FollowedCamera): readonly Stage<VisibilityOptions>[] {
    return stagesFor(this.#settings, this.#points, this.#drawsMaps() && place?.isDirection !== true);
  }

  #added(camera: Camera): FollowedCamera {
    const followed = new FollowedCamera(camera, this.#wake);
    this.#cameras.set(camera, followed);
    if (this.#cameras.size > MOST) {
      const [oldest, given] = this.#cameras.entries().next().value!;
      this.#cameras.delete(oldest);
      given.stop();
      this.#dropped(given);
    }
    return followed;
  }
}

/** How far a matrix may differ from a similarity: rounding to single precision makes such differences. */
const DISTORTION = 1e-5;
/** The relative rounding error of world coordinates after the product of several matrices. */
const ROUNDING = 1e-14;

/** The space of a cloud: that of an object, or the world. */
export type Space = Pick<Object3D, "updateWorldMatrix"> & { readonly matrixWorld: Pick<Matrix4, "elements"> };

/**
 * The place that a camera looks from, or the direction that it looks along, in the space of the cloud, and how far
 * rounding may move this place. `origin`: the zero of the points' space in the cloud.
 *
 * @throws HprError `option` for a scale that is not uniform.
 */
function placeOf(
  camera: Camera,
  points: Space,
  origin: readonly number[] = [0, 0, 0],
): { place: Place; rounding: number } {
  camera.updateWorldMatrix(true, false);
  const c = camera.matrixWorld.elements;
  // The projection matrix shows this, also for cameras of other classes.
  const isDirection = camera.projectionMatrix.elements[15] !== 0 && !("isPerspectiveCamera" in camera);
  if (isDirection) {
    // The third axis of a camera points backwards.
    const along = inSpace(points, [-c[8], -c[9], -c[10]], true);
    const length = Math.hypot(...along);
    return { place: { from: along.map((part) => part / length), isDirection }, rounding: 0 };
  }
  const from = inSpace(points, [c[12], c[13], c[14]]).map((x, axis) => x + origin[axis]!);
  const m = points.matrixWorld.elements;
  const reach = [12, 13, 14].reduce((sum, i) => sum + Math.abs(c[i]!) + Math.abs(m[i]!), 0);
  const along = inSpace(points, [-c[8], -c[9], -c[10]], true);
  const place = { from, isDirection, cone: coneOf(camera.projectionMatrix.elements, along) };
  return { place, rounding: (ROUNDING * reach) / uniformScale(m) };
}

/**
 * A place in the world, or a direction, in the space of the points.
 *
 * @throws HprError `option` for a scale that is not uniform.
 */
export function inSpace(points: Space, world: readonly [number, number, number], isDirection = false): number[] {
  points.updateWorldMatrix(true, false);
  const m = points.matrixWorld.elements;
  uniformScale(m);
  // Cramer's rule. The translation is subtracted first, so far-away places lose no precision.
  const [x, y, z] = isDirection ? world : [world[0] - m[12], world[1] - m[13], world[2] - m[14]];
  const [ax, ay, az] = [m[5] * m[10] - m[6] * m[9], m[6] * m[8] - m[4] * m[10], m[4] * m[9] - m[5] * m[8]];
  const [bx, by, bz] = [m[9] * m[2] - m[10] * m[1], m[10] * m[0] - m[8] * m[2], m[8] * m[1] - m[9] * m[0]];
  const [cx, cy, cz] = [m[1] * m[6] - m[2] * m[5], m[2] * m[4] - m[0] * m[6], m[0] * m[5] - m[1] * m[4]];
  const determinant = m[0] * ax + m[1] * ay + m[2] * az;
  return [
    (x * ax + y * ay + z * az) / determinant,
    (x * bx + y * by + z * bz) / determinant,
    (x * cx + y * cy + z * cz) / determinant,
  ];
}

/** @throws HprError `option` if the scale from the points' space to the world is not uniform. */
export function requireUniformScale(points: Object3D): void {
  points.updateWorldMatrix(true, false);
  uniformScale(points.matrixWorld.elements);
}

function requireCamera(camera: unknown): void {
  if (typeof camera !== "object" || camera === null || !("isCamera" in camera)) {
    throw new HprError("option", `camera must be a THREE.Camera, got ${describe(camera)}`);
  }
}

/** Returns the scale from the points' space to the world. A mirrored space is accepted. */
function uniformScale(m: readonly number[]): number {
  const a = Math.hypot(m[0]!, m[1]!, m[2]!);
  const b = Math.hypot(m[4]!, m[5]!, m[6]!);
  const c = Math.hypot(m[8]!, m[9]!, m[10]!);
  const ab = m[0]! * m[4]! + m[1]! * m[5]! + m[2]! * m[6]!;
  const bc = m[4]! * m[8]! + m[5]! * m[9]! + m[6]! * m[10]!;
  const ca = m[8]! * m[0]! + m[9]! * m[1]! + m[10]! * m[2]!;
  const most = Math.max(a, b, c);
  const skew = Math.max(Math.abs(ab), Math.abs(bc), Math.abs(ca)) / most;
  const isUniform = most - Math.min(a, b, c) <= DISTORTION * most && skew <= DISTORTION * most && most > 0;
  if (!isUniform || !Number.isFinite(most)) {
    const scales = [a, b, c].map((length) => Number(length.toPrecision(6))).join(", ");
    throw new HprError(
      "option",
      `scale must be the same along all axes (and not zero), in all parents together, got ${scales}`,
    );
  }
  return most;
}
