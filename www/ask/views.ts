import { HprError, type Visibility, type VisibilityMap, type VisibilityOptions } from "hidden-point-removal";
import type { ViewQuestion } from "./question.ts";
import type { WorkerCloud } from "./worker-cloud.ts";

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
