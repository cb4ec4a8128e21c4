import { hasNodeModules, importNodeModule } from "../base/node.js";

/** More workers would only wait for memory, and each of them holds the whole cloud. */
export const MAX_WORKERS = 64;
/** For fewer points, a second worker gains too little. */
const CROSSOVER = 200_000;
/** The largest number of points by default, summed over the copies of all workers. */
const MAX_DEFAULT_POINTS = 16_000_000;

/** How many workers gain something when they share many views of a cloud with this number of points. */
export async function defaultWorkers(points: number): Promise<number> {
  if (points < CROSSOVER) {
    return 1;
  }
  const fit = Math.floor(MAX_DEFAULT_POINTS / points);
  return Math.max(1, Math.min(await cores(), MAX_WORKERS, fit));
}

async function cores(): Promise<number> {
  const { navigator } = globalThis as { navigator?: { hardwareConcurrency?: unknown } };
  const count = navigator?.hardwareConcurrency;
  if (typeof count === "number" && count >= 1) {
    return Math.floor(count);
  }
  if (hasNodeModules()) {
    const os = await importNodeModule<typeof import("node:os")>("node:os");
    return os.availableParallelism();
  }
  return 1;
}
