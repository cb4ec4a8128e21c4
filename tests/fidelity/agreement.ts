import { dragonMesh, RayTracer } from "./rays.js";
import { scanned } from "./truth.js";

const NAME = "dragon_res3";

export interface Agreement {
  name: string;
  labels: number;
  same: number;
}

/** Compares the ray tracer with labels from another ray tracer. Undefined if these are missing. */
export function traceAgain(say: (message: string) => void): Agreement | undefined {
  const labelled = [...scanned()].find(({ name }) => name === NAME);
  if (labelled === undefined) return undefined;
  say(`Tracing rays to ${labelled.views.length} viewpoints of ${NAME}…`);
  const tracer = new RayTracer(dragonMesh(NAME));
  let [labels, same] = [0, 0];
  for (const { viewpoint, seen } of labelled.views) {
    const traced = tracer.visibleFrom(viewpoint);
    labels += seen.length;
    same += traced.filter((label, i) => label === seen[i]).length;
  }
  return { name: NAME, labels, same };
}
