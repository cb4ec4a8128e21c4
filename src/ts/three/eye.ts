import type { Camera, Matrix4, Object3D } from "three";

import { describe, HprError } from "../base/errors.js";
import type { Place } from "../query/place.js";

/** How far a matrix may differ from a similarity: rounding to single precision makes such differences. */
const DISTORTION = 1e-5;
/** The relative rounding error of world coordinates after the product of several matrices. */
const ROUNDING = 1e-14;

/** The space of a cloud: that of an object, or the world. */
export type Space = Pick<Object3D, "updateWorldMatrix"> & { readonly matrixWorld: Pick<Matrix4, "elements"> };

/**
 * The place that a camera looks from, or the direction that it looks along, in the space of the points, and how far
 * rounding may move this place.
 *
 * @throws HprError `option` for a scale that is not uniform.
 */
export function placeOf(camera: Camera, points: Space): { place: Place; rounding: number } {
  points.updateWorldMatrix(true, false);
  camera.updateWorldMatrix(true, false);
  const [m, c] = [points.matrixWorld.elements, camera.matrixWorld.elements];
  const scale = uniformScale(m);
  const isDirection = isOrthographic(camera);
  // The third axis of a camera points backwards.
  const x = isDirection ? -c[8] : c[12] - m[12];
  const y = isDirection ? -c[9] : c[13] - m[13];
  const z = isDirection ? -c[10] : c[14] - m[14];

  // Cramer's rule. The translation is subtracted first, so far-away places lose no precision.
  const [ax, ay, az] = [m[5] * m[10] - m[6] * m[9], m[6] * m[8] - m[4] * m[10], m[4] * m[9] - m[5] * m[8]];
  const [bx, by, bz] = [m[9] * m[2] - m[10] * m[1], m[10] * m[0] - m[8] * m[2], m[8] * m[1] - m[9] * m[0]];
  const [cx, cy, cz] = [m[1] * m[6] - m[2] * m[5], m[2] * m[4] - m[0] * m[6], m[0] * m[5] - m[1] * m[4]];
  const determinant = m[0] * ax + m[1] * ay + m[2] * az;
  const from = [
    (x * ax + y * ay + z * az) / determinant,
    (x * bx + y * by + z * bz) / determinant,
    (x * cx + y * cy + z * cz) / determinant,
  ];
  if (isDirection) {
    const length = Math.hypot(...from);
    return { place: { from: from.map((part) => part / length), isDirection }, rounding: 0 };
  }
  const reach = [12, 13, 14].reduce((sum, i) => sum + Math.abs(c[i]!) + Math.abs(m[i]!), 0);
  return { place: { from, isDirection }, rounding: (ROUNDING * reach) / scale };
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
