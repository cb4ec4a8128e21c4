import type { Inversion, Radius, Settings, Viewpoint, Viewpoints } from "../settings/settings.ts";

/** How the library decides which points a viewpoint or a light sees. */
export interface Method {
  /** Only for the spherical flip; `null` for the others. */
  radius: Radius | null;
  inversion: Inversion;
  denoise: number;
  vote: number;
}

/** Surfaces have only one viewpoint. */
export type Shape = { kind: "points"; viewpoints: Viewpoints } | { kind: "surface"; edge: number };

/** The question of what can be seen, and how it is shown. */
export interface ViewQuestion {
  viewpoint: Viewpoint;
  method: Method;
  shape: Shape;
  /** A quick question that is asked instead of a slower one. */
  quick?: boolean;
}

/** The question of what the lights reach. */
export interface LightQuestion {
  lights: readonly Viewpoint[];
  soft: number;
  ambient: number;
  smoothing: number;
  method: Method;
  /** The triangles over which the light is interpolated. */
  mesh: Uint32Array | null;
}

export function methodOf({ radius, inversion, denoise, vote }: Settings): Method {
  return { radius: inversion === "spherical" ? radius : null, inversion, denoise, vote };
}

export function shapeOf({ show, viewpoints, edge }: Settings): Shape {
  return show === "points" ? { kind: "points", viewpoints } : { kind: "surface", edge };
}

/*
 * The rules that search take 6 and about 40 hulls. While the viewpoint or the lights move, the automatic radius
 * replaces them, and single points replace soft lights. When everything is at rest, the question is asked with the real
 * settings.
 */

export function quickView(question: ViewQuestion): ViewQuestion {
  const method = quickMethod(question.method);
  return method === question.method ? question : { ...question, method, quick: true };
}

export function quickLight(question: LightQuestion): LightQuestion {
  return { ...question, soft: 0, method: quickMethod(question.method) };
}

function quickMethod(method: Method): Method {
  return isSlow(method) ? { ...method, radius: { rule: "auto" } } : method;
}

/** Whether the choice of the radius takes many hulls. */
export function isSlow(method: Method): boolean {
  return method.radius !== null && "rule" in method.radius && !isAutomatic(method);
}

/** Whether the answer's own exponent is the automatic one. */
export function isAutomatic({ radius }: Method): boolean {
  return radius !== null && "rule" in radius && radius.rule === "auto";
}

/**
 * Orbit controls change the viewpoint by a few bits even if nothing has moved. So a move by less than this share of the
 * cloud's size does not count.
 */
const SAME = 1e-9;

export function isSamePlace(a: Viewpoint, b: Viewpoint, size: number): boolean {
  return a.every((value, axis) => Math.abs(value - b[axis]!) <= SAME * size);
}

export function isSameView(a: ViewQuestion, b: ViewQuestion, size: number): boolean {
  return isSamePlace(a.viewpoint, b.viewpoint, size) && textOf([a.method, a.shape]) === textOf([b.method, b.shape]);
}

export function isSameLight({ mesh: a, ...rest }: LightQuestion, { mesh: b, ...others }: LightQuestion): boolean {
  return a === b && textOf(rest) === textOf(others);
}

/** JSON writes infinity as null. That is safe, because no other number here becomes null. */
function textOf(value: unknown): string {
  return JSON.stringify(value);
}
