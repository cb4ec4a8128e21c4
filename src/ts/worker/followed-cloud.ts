import type { PointCloud } from "../cloud/cloud.js";
import type { AskedStage, Seen } from "../follow/view.js";
import { type Place, widened } from "../query/positions.js";
import type { VisibilityOptions } from "../query/view-options.js";
import { WorkerPointCloud } from "./client.js";

/** Both classes give the same answers. A `WorkerPointCloud` gives them as promises. */
export type Cloud = PointCloud | WorkerPointCloud;

/**
 * Asks either kind of cloud. The signal works only in a worker: elsewhere, the answer comes at once. `origin`: the place
 * that the positions of a map's shader are relative to.
 */
export function see(
  cloud: Cloud,
  { from, isDirection, cone }: Place,
  { kind, options, signal, points }: Pick<AskedStage<VisibilityOptions>, "kind" | "options" | "signal" | "points">,
  origin?: readonly number[],
): Seen | Promise<Seen> {
  const asked = cloud instanceof WorkerPointCloud ? { ...options, signal } : options;
  if (kind === "map") {
    return cloud.visibilityMap(from, { ...asked, points, towards: widened(cone), origin });
  }
  return isDirection ? cloud.visibleFromDirection(from, asked) : cloud.visibleFrom(from, asked);
}
