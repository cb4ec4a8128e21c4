import {
  canLook,
  type Inversion,
  type Looks,
  type Radius,
  type Settings,
  type Viewpoint,
} from "../settings/settings.ts";
import {
  HprError,
  type Inversion as LibraryInversion,
  type Visibility,
  type VisibilityMap,
  type VisibilityOptions,
} from "hidden-point-removal";
import type { WorkerPointCloud } from "hidden-point-removal/worker";

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

export function kindOf({ map, method }: ViewQuestion): "map" | "operator" | "looks" {
  if (map) return "map";
  return method.looks > 0 ? "looks" : "operator";
}

/** The questions that lead to a final answer: one hull, which is soon there, and then the looks, if they are wanted. */
export function stagesOf(final: ViewQuestion): ViewQuestion[] {
  const { method } = final;
  if (method.looks === 0) return [final];
  const hull: Method = { ...method, radius: { rule: "auto" }, looks: 0, thickness: undefined };
  return [{ ...final, method: hull }, final];
}

/** The questions while the camera moves: a map for each frame, and at rest the final answer. */
export function mappedStagesOf(final: ViewQuestion): ViewQuestion[] {
  return [{ ...final, map: true }, final];
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
    a.map === b.map &&
    JSON.stringify(a.method) === JSON.stringify(b.method)
  );
}

/** The cloud in its worker. It takes questions in the page's terms. */
export class WorkerCloud {
  readonly points: WorkerPointCloud;
  /** The middle of the bounding box, in the file's coordinates. */
  readonly center: Viewpoint;

  constructor(points: WorkerPointCloud, center: Viewpoint) {
    this.points = points;
    this.center = center;
  }

  options({ radius, inversion, looks, thickness }: Method): VisibilityOptions {
    return {
      ...(radius === null
        ? {}
        : "rule" in radius
          ? { radius: radius.rule }
          : "length" in radius
            ? { radius: radius.length }
            : radius),
      ...(inversion === "spherical" ? {} : { inversion: this.#inversion(inversion) }),
      ...(looks === 0 ? {} : { looks, thickness }),
    };
  }

  #inversion({ exponential }: Exclude<Method["inversion"], "spherical">): LibraryInversion {
    return { exponential: exponential === "auto" ? "auto" : exponential * this.points.spacing };
  }
}

/** The worker's answer, with its question. */
export interface ViewAnswer {
  question: ViewQuestion;
  visibility: Visibility;
  /** Why the library refused the settings, if its defaults were used instead. */
  note: string | null;
}

/** Finds what a viewpoint sees. If the settings do not suit the cloud or the place, the library's defaults are used. */
export async function askView(cloud: WorkerCloud, question: ViewQuestion, signal?: AbortSignal): Promise<ViewAnswer> {
  const { viewpoint, method } = question;
  const { value, note } = await orUsual(cloud.options(method), (options) =>
    cloud.points.visibleFrom(viewpoint, { ...options, signal }),
  );
  return { question, visibility: value, note };
}

/** A map for a viewpoint, of so many points, with positions relative to the middle of the cloud. */
export async function askMap(
  cloud: WorkerCloud,
  { viewpoint, method }: ViewQuestion,
  points?: number,
): Promise<VisibilityMap> {
  const { value } = await orUsual(cloud.options(method), (options) =>
    cloud.points.visibilityMap(viewpoint, { ...options, points, origin: cloud.center }),
  );
  return value;
}

/** Runs `ask` with the options. If these are refused, runs it without options, and says why. */
async function orUsual<T>(
  options: VisibilityOptions,
  ask: (options: VisibilityOptions) => Promise<T>,
): Promise<{ value: T; note: string | null }> {
  try {
    return { value: await ask(options), note: null };
  } catch (error) {
    if (!(error instanceof HprError) || (error.code !== "radius" && error.code !== "option")) throw error;
    const note = `These settings do not suit this cloud or place, so the usual ones are used: ${error.message.replace(/\.$/, "")}.`;
    return { value: await ask({}), note };
  }
}
