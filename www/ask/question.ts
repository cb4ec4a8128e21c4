import type { AnswerKind } from "hidden-point-removal/worker";
import {
  canLook,
  type Inversion,
  type Looks,
  type Radius,
  type Settings,
  type Viewpoint,
} from "../settings/settings.ts";

/** How the library decides which points a viewpoint sees. */
export interface Method {
  /** Only for the spherical flip; `null` for the others, and with looks. */
  radius: Radius | null;
  inversion: Inversion;
  /** 0: the operator of the paper. */
  looks: Looks;
  /** Only with looks. Undefined: it follows from the noise of the cloud. */
  thickness?: number | undefined;
}

/** The question of what can be seen. */
export interface ViewQuestion {
  viewpoint: Viewpoint;
  method: Method;
  /** Asks for an early answer, which also has some hidden points. */
  draft?: boolean;
  /** Asks for a map of directions, by which the graphics card leaves out hidden points. */
  map?: boolean;
}

/** The operator of the paper with these settings. */
export function operatorOf({ radius, inversion }: Settings): Method {
  return { radius: inversion === "spherical" ? radius : null, inversion, looks: 0 };
}

/** The question whose answer is final. */
export function viewOf(viewpoint: Viewpoint, settings: Settings): ViewQuestion {
  const { looks, thickness } = settings;
  const method = operatorOf(settings);
  return looks > 0 && canLook(settings)
    ? { viewpoint, method: { ...method, radius: null, looks, ...(thickness !== "auto" && { thickness }) } }
    : { viewpoint, method };
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
 * The last of the three is missing if one hull is the final answer. `drafts`: whether the cloud is so large that a draft
 * is worth its time.
 */
export function stagesOf(final: ViewQuestion, drafts: boolean): ViewQuestion[] {
  const operator = isSlow(final.method) ? { ...final, method: quickMethod(final.method) } : final;
  const first = drafts ? [{ ...operator, draft: true }] : [];
  return [...first, operator, ...(operator === final ? [] : [final])];
}

/**
 * The questions while the camera moves: a map for each frame, and at rest the final answer. Null if a map cannot tell what
 * the final answer hides.
 */
export function mappedStagesOf(final: ViewQuestion): ViewQuestion[] | null {
  return isSearched(final.method) ? null : [{ ...final, map: true }, final];
}

/*
 * The rules that search take 6 and about 40 hulls, looks take three. While the viewpoint moves, the automatic radius
 * replaces them.
 */

function quickMethod(method: Method): Method {
  return isSlow(method) ? { ...method, radius: { rule: "auto" }, looks: 0, thickness: undefined } : method;
}

/** Whether the answer takes several hulls. */
export function isSlow(method: Method): boolean {
  return method.looks > 0 || isSearched(method);
}

/** Whether the choice of the radius takes many hulls. */
export function isSearched({ radius }: Method): boolean {
  return radius !== null && "rule" in radius && radius.rule !== "auto";
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
    JSON.stringify(a.method) === JSON.stringify(b.method)
  );
}
