import type { Viewpoint } from "../../settings/settings.ts";
import type { Placed } from "../figures.ts";

/** Places on a grid over the ground: so many along the longer side. */
const ALONG = 7;

/**
 * Places where an instrument could stand: on a grid over the cloud, `height` above the lowest points there. Cells
 * without points have no ground to stand on.
 */
export function candidatesOver({ cloud, positions }: Placed, upward: readonly number[], height: number): Viewpoint[] {
  const axis = upward.findIndex((part) => part !== 0);
  const sign = upward[axis]!;
  const [a, b] = [0, 1, 2].filter((other) => other !== axis) as [number, number];
  const low = [0, 1, 2].map((k) => cloud.center[k]! - cloud.size[k]! / 2);
  const side = Math.max(cloud.size[a]!, cloud.size[b]!) / ALONG || 1;
  const cells = new Map<string, { i: number; j: number; ground: number }>();
  for (let point = 0; point < cloud.count; point++) {
    const i = Math.floor((positions[3 * point + a]! - low[a]!) / side);
    const j = Math.floor((positions[3 * point + b]! - low[b]!) / side);
    const up = sign * positions[3 * point + axis]!;
    const key = `${i} ${j}`;
    const cell = cells.get(key);
    if (!cell) cells.set(key, { i, j, ground: up });
    else if (up < cell.ground) cell.ground = up;
  }
  return [...cells.values()].map(({ i, j, ground }) => {
    const at: Viewpoint = [0, 0, 0];
    at[a] = low[a]! + (i + 0.5) * side;
    at[b] = low[b]! + (j + 0.5) * side;
    at[axis] = sign * (ground + height);
    return at;
  });
}
