import type { Camera, Matrix4, Object3D } from "three";

import { describe, HprError } from "../base/errors.js";
import type { Place } from "../query/place.js";

/** How far a matrix may differ from a similarity: rounding to single precision makes such differences. */
const DISTORTION = 1e-5;
/** How far a direction of length 1 may turn for a move threshold of 1. */
const TURN = 1e-3;
/** The relative rounding error of world coordinates after the product of several matrices. */
const ROUNDING = 1e-14;

/** The space of a cloud: that of an object, or the world. */
export type Space = Pick<Object3D, "updateWorldMatrix"> & { readonly matrixWorld: Pick<Matrix4, "elements"> };

/**
 * The place that a camera looks from, or the direction that it looks along, in the space of the
 * points. An answer depends on this. It is read in every frame, so nothing is allocated.
 */
export class Eye {
  /** The cloud's spacing. */
  spacing = 0;
  readonly #moveThreshold: number;
  readonly #now = { known: false, direction: false, x: 0, y: 0, z: 0, blur: 0 };
  readonly #noted = { known: false, direction: false, x: 0, y: 0, z: 0 };

  /** `moveThreshold` is the option of that name. */
  constructor(moveThreshold: number) {
    this.#moveThreshold = moveThreshold;
  }

  /** @throws HprError `option` for a value that is not a camera, or a scale that is not uniform. */
  look(points: Space, camera: Camera): void {
    requireCamera(camera);
    points.updateWorldMatrix(true, false);
    camera.updateWorldMatrix(true, false);
    const [m, c] = [points.matrixWorld.elements, camera.matrixWorld.elements];
    const scale = uniformScale(m);
    const direction = isOrthographic(camera);
    // The third axis of a camera points backwards.
    const x = direction ? -c[8] : c[12] - m[12];
    const y = direction ? -c[9] : c[13] - m[13];
    const z = direction ? -c[10] : c[14] - m[14];

    // Cramer's rule. The translation is subtracted first, so far-away places lose no precision.
    const [ax, ay, az] = [m[5] * m[10] - m[6] * m[9], m[6] * m[8] - m[4] * m[10], m[4] * m[9] - m[5] * m[8]];
    const [bx, by, bz] = [m[9] * m[2] - m[10] * m[1], m[10] * m[0] - m[8] * m[2], m[8] * m[1] - m[9] * m[0]];
    const [cx, cy, cz] = [m[1] * m[6] - m[2] * m[5], m[2] * m[4] - m[0] * m[6], m[0] * m[5] - m[1] * m[4]];
    const determinant = m[0] * ax + m[1] * ay + m[2] * az;
    const now = this.#now;
    now.x = (x * ax + y * ay + z * az) / determinant;
    now.y = (x * bx + y * by + z * bz) / determinant;
    now.z = (x * cx + y * cy + z * cz) / determinant;
    now.known = true;
    now.direction = direction;
    if (direction) {
      const length = Math.hypot(now.x, now.y, now.z);
      now.x /= length;
      now.y /= length;
      now.z /= length;
      now.blur = TURN * this.#moveThreshold;
    } else {
      const reach =
        Math.abs(c[12]) + Math.abs(c[13]) + Math.abs(c[14]) + Math.abs(m[12]) + Math.abs(m[13]) + Math.abs(m[14]);
      const blur = this.#moveThreshold * this.spacing + (ROUNDING * reach) / scale;
      now.blur = Number.isFinite(blur) ? blur : 0;
    }
  }

  /** Whether a view was noted. */
  get isKnown(): boolean {
    return this.#noted.known;
  }

  /** Whether the noted view is a direction. */
  get isDirection(): boolean {
    return this.#noted.direction;
  }

  /** Whether the present view is not the one that was noted last. */
  get isNew(): boolean {
    const [now, noted] = [this.#now, this.#noted];
    if (!now.known) {
      return false;
    }
    const isSame =
      noted.known &&
      noted.direction === now.direction &&
      isNear(noted.x, now.x, now.blur) &&
      isNear(noted.y, now.y, now.blur) &&
      isNear(noted.z, now.z, now.blur);
    return !isSame;
  }

  /** Notes the present view: questions are about it until another one is noted. */
  note(): void {
    const { direction, x, y, z } = this.#now;
    Object.assign(this.#noted, { known: true, direction, x, y, z });
  }

  /** The view that was noted. */
  get place(): Place {
    const { direction, x, y, z } = this.#noted;
    return { from: [x, y, z], isDirection: direction };
  }
}

/** NaN is equal to NaN here, so that it is refused only once. */
function isNear(a: number, b: number, blur: number): boolean {
  return Math.abs(a - b) <= blur || Object.is(a, b);
}

/** @throws HprError `option` if the scale from the points' space to the world is not uniform. */
export function requireUniformScale(points: Object3D): void {
  points.updateWorldMatrix(true, false);
  uniformScale(points.matrixWorld.elements);
}

export function requireCamera(camera: unknown): void {
  if (typeof camera !== "object" || camera === null || !("isCamera" in camera)) {
    throw new HprError("option", `camera must be a THREE.Camera, got ${describe(camera)}`);
  }
}

/** Whether a camera is orthographic. The projection matrix shows this, also for cameras of other classes. */
function isOrthographic(camera: Camera): boolean {
  return camera.projectionMatrix.elements[15] !== 0 && !("isPerspectiveCamera" in camera);
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
