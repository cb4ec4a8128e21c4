import type { AnswerKind } from "hidden-point-removal/worker";
import {
  canLook,
  type Inversion,
  type Looks,
  type Radius,
  type Settings,
  type Viewpoint,
  type Viewpoints,
} from "../settings/settings.ts";

/** How the library decides which points a viewpoint or a light sees. */
export interface Method {
  /** Only for the spherical flip; `null` for the others, and with looks. */
  radius: Radius | null;
  inversion: Inversion;
  /** 0: the operator of the paper. */
  looks: Looks;
  /** Only with looks. Undefined: it follows from the noise of the cloud. */
  thickness?: number | undefined;
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
  /** Asks for an early answer, which also has some hidden points. */
  draft?: boolean;
  /** Asks for a map of directions, by which the graphics card leaves out hidden points. */
  map?: boolean;
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

/** The operator of the paper with these settings. */
export function operatorOf({ radius, inversion, denoise, vote }: Settings): Method {
  return { radius: inversion === "spherical" ? radius : null, inversion, looks: 0, denoise, vote };
}

/** The question whose answer is final. */
export function viewOf(viewpoint: Viewpoint, settings: Settings): ViewQuestion {
  const { show, viewpoints, edge, looks, thickness } = settings;
  const method = operatorOf(settings);
  if (show === "surface") return { viewpoint, method, shape: { kind: "surface", edge } };
  const shape: Shape = { kind: "points", viewpoints };
  return looks > 0 && canLook(settings)
    ? { viewpoint, method: { ...method, radius: null, looks, ...(thickness !== "auto" && { thickness }) }, shape }
    : { viewpoint, method, shape };
}

export function kindOf({ draft, map, method }: ViewQuestion): AnswerKind {
  if (map) return "map";
  if (draft) return "draft";
  return method.looks > 0 ? "looks" : "operator";
}

/**
 * The questions that lead to a final answer, each slower and better than the one before:
 *
 *     draft ─► one hull ─► looks, or a radius that is searched
 *
 * The last of the three is missing if one hull is the final answer. A surface has no draft. `drafts`: whether the cloud
 * is so large that a draft is worth its time.
 */
export function stagesOf(final: ViewQuestion, drafts: boolean): ViewQuestion[] {
  const operator = isSlow(final.method) ? { ...final, method: quickMethod(final.method) } : final;
  const first = drafts && final.shape.kind === "points" ? [{ ...operator, draft: true }] : [];
  return [...first, operator, ...(operator === final ? [] : [final])];
}

/**
 * The questions while the camera moves: a map for each frame, and at rest the final answer. Null if a map cannot tell what
 * the final answer hides.
 */
export function mappedStagesOf(final: ViewQuestion): ViewQuestion[] | null {
  const { method, shape } = final;
  const isOne = shape.kind === "points" && shape.viewpoints === "one";
  const hasMap = isOne && method.vote === 0 && method.denoise === 0 && !isSearched(method);
  return hasMap ? [{ ...final, map: true }, final] : null;
}

/*
 * The rules that search take 6 and about 40 hulls, looks take three. While the viewpoint or the lights move, the
 * automatic radius replaces them, and single points replace soft lights.
 */

export function quickLight(question: LightQuestion): LightQuestion {
  return { ...question, soft: 0, method: quickMethod(question.method) };
}

function quickMethod(method: Method): Method {
  return isSlow(method) ? { ...method, radius: { rule: "auto" }, looks: 0, thickness: undefined } : method;
}

/** Whether the answer takes several hulls. */
export function isSlow(method: Method): boolean {
  return method.looks > 0 || isSearched(method);
}

/** Whether the choice of the radius takes many hulls. */
export function isSearched(method: Method): boolean {
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
  return (
    isSamePlace(a.viewpoint, b.viewpoint, size) &&
    a.draft === b.draft &&
    a.map === b.map &&
    textOf([a.method, a.shape]) === textOf([b.method, b.shape])
  );
}

export function isSameLight({ mesh: a, ...rest }: LightQuestion, { mesh: b, ...others }: LightQuestion): boolean {
  return a === b && textOf(rest) === textOf(others);
}

/** JSON writes infinity as null. That is safe, because no other number here becomes null. */
function textOf(value: unknown): string {
  return JSON.stringify(value);
}
