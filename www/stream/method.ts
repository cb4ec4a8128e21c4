import type { Settings } from "../settings/settings.ts";
import type { StreamMethod } from "./protocol.ts";

/**
 * How a streamed octree is seen with these settings. `null`: they need all points at once. The automatic radius
 * and looks do, too. For them, the automatic exponential inversion is used.
 */
export function streamMethodOf({ radius, inversion }: Settings): StreamMethod | null {
  if (inversion !== "spherical") return inversion;
  if ("length" in radius) return { length: radius.length };
  return "rule" in radius ? "automatic" : null;
}
