import type { LightQuestion } from "./question.ts";
import { orUsual } from "./views.ts";
import type { WorkerCloud } from "./worker-cloud.ts";

export interface LightAnswer {
  question: LightQuestion;
  /** The brightness from 0 to 1, for each index of the cloud. */
  brightness: Float32Array;
  note: string | null;
}

/** The number of lights on the rim of a soft light, besides the one in its middle. */
const RIM = 8;

/** The brightness of every point under the lights, seen or not. */
export async function askLight(
  cloud: WorkerCloud,
  question: LightQuestion,
  signal?: AbortSignal,
): Promise<LightAnswer> {
  const { lights, soft, ambient, smoothing, method, mesh } = question;
  const rims = soft > 0 ? await Promise.all(lights.map((light) => cloud.ring(light, RIM, soft))) : [];
  const all = [...lights, ...rims.flat()];
  const { value, note } = await orUsual(
    () => cloud.options(method, lights[0]!),
    (options) =>
      cloud.points.illuminate(all, { ...options, signal, ambient, smoothing, ...(mesh ? { triangles: mesh } : {}) }),
  );
  return { question, brightness: value, note };
}
