import type { Inversion, Radius, Settings, Viewpoint, Viewpoints } from "../settings/settings.ts";

/** How the library is to decide what a viewpoint or a light sees. */
export interface Method {
  /** Of the spherical flip alone; `null` with the others. */
  radius: Radius | null;
  inversion: Inversion;
  denoise: number;
  vote: number;
}

/** A surface is that of one viewpoint. */
export type Shape = { kind: "points"; viewpoints: Viewpoints } | { kind: "surface"; edge: number };

/** What can be seen, and as what. */
export interface ViewQuestion {
  viewpoint: Viewpoint;
  method: Method;
  shape: Shape;
  /** Asked in the place of a slower one. */
  quick?: boolean;
}

/** What the lights reach. */
export interface LightQuestion {
  lights: readonly Viewpoint[];
  soft: number;
  ambient: number;
  smoothing: number;
  method: Method;
  /** The triangles that the light is spread over. */
  mesh: Uint32Array | null;
}

export function methodOf({ radius, inversion, denoise, vote }: Settings): Method {
  return { radius: inversion === "spherical" ? radius : null, inversion, denoise, vote };
}

export function shapeOf({ show, viewpoints, edge }: Settings): Shape {
  return show === "points" ? { kind: "points", viewpoints } : { kind: "surface", edge };
}

/*
 * The rules that search take 6 and about 40 hulls. As long as the viewpoint or the lights move, the automatic radius
 * stands in for them and single points for soft lights; when all has come to rest the question is asked as it is meant.
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

/** Whether the radius takes many hulls to choose. */
export function isSlow(method: Method): boolean {
  return method.radius !== null && "rule" in method.radius && !isAutomatic(method);
}

/** Whether the answer's own exponent is the automatic one. */
export function isAutomatic({ radius }: Method): boolean {
  return radius !== null && "rule" in radius && radius.rule === "auto";
}

/** Orbit controls come back some bits off when nothing has moved; so little of the cloud's size is no new viewpoint. */
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

/** Infinity, the one number here that JSON does not know, becomes the one null. */
function textOf(value: unknown): string {
  return JSON.stringify(value);
}
