import { HprError, type Visibility, type VisibilityMap, type VisibilityOptions } from "hidden-point-removal";
import type { RequestOptions } from "hidden-point-removal/worker";
import { USUAL_EDGE } from "../settings/settings.ts";
import type { ViewQuestion } from "./question.ts";
import type { WorkerCloud } from "./worker-cloud.ts";

/** The worker's answer, with its question. */
export interface ViewAnswer {
  question: ViewQuestion;
  visibility: Visibility;
  /** The triangles of the surface, if it was asked for. */
  triangles: Uint32Array | null;
  /** Why the library refused the settings, if its defaults were used instead. */
  note: string | null;
}

/** The distance between the ring's viewpoints and the viewpoint in its middle, as a share of the viewing distance. */
const RING = { count: 4, fraction: 0.05 };

/** Finds what a viewpoint sees. If the settings do not suit the cloud or the place, the library's defaults are used. */
export async function askView(cloud: WorkerCloud, question: ViewQuestion, signal?: AbortSignal): Promise<ViewAnswer> {
  const { viewpoint, method } = question;
  const { value, note } = await orUsual(
    () => cloud.options(method, viewpoint),
    (options) => see(cloud, question, { ...options, signal }),
  );
  return { question, ...value, note };
}

/** A map for a viewpoint, with positions relative to the middle of the cloud. */
export async function askMap(cloud: WorkerCloud, { viewpoint, method }: ViewQuestion): Promise<VisibilityMap> {
  const { value } = await orUsual(
    () => cloud.options(method, viewpoint),
    (options) => cloud.points.visibilityMap(viewpoint, { ...options, origin: cloud.center }),
  );
  return value;
}

/** Runs `ask` with the options. If these are refused, runs it without options, and says why. */
export async function orUsual<T>(
  options: () => Promise<VisibilityOptions>,
  ask: (options: VisibilityOptions) => Promise<T>,
): Promise<{ value: T; note: string | null }> {
  try {
    return { value: await ask(await options()), note: null };
  } catch (error) {
    if (!(error instanceof HprError) || (error.code !== "radius" && error.code !== "option")) throw error;
    const note = `These settings do not suit this cloud or place, so the usual ones are used: ${error.message.replace(/\.$/, "")}.`;
    return { value: await ask({}), note };
  }
}

async function see(
  cloud: WorkerCloud,
  { viewpoint, shape, draft }: ViewQuestion,
  given: VisibilityOptions & RequestOptions,
): Promise<Pick<ViewAnswer, "visibility" | "triangles">> {
  const options = draft ? { ...given, draft } : given;
  if (shape.kind === "surface") {
    const maxEdge =
      shape.edge === USUAL_EDGE ? undefined : shape.edge === Infinity ? Infinity : shape.edge * cloud.points.spacing;
    const surface = await cloud.points.reconstruct(viewpoint, { ...options, maxEdge });
    return { visibility: surface, triangles: surface.triangles };
  }
  if (shape.viewpoints === "one") {
    return { visibility: await cloud.points.visibleFrom(viewpoint, options), triangles: null };
  }
  const five = [viewpoint, ...(await cloud.ring(viewpoint, RING.count, RING.fraction))];
  const visibility =
    shape.viewpoints === "any"
      ? cloud.points.visibleFromAny(five, options)
      : cloud.points.visibleFromAtLeast(2, five, options);
  return { visibility: await visibility, triangles: null };
}
