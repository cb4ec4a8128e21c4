import type { Cloud } from "../cloud/cloud.ts";
import type { Settings } from "../settings/settings.ts";

/** The part of a cloud that is looked at. A point outside is neither seen nor hides anything. */
export type Part = Pick<Settings, "box" | "without">;

/** 1 for each point of other classes than those that are left out. Undefined: all points. */
export function classMask(cloud: Cloud, { without }: Part): Uint8Array | undefined {
  const column = without && cloud.attributes.find(({ name }) => name === without.column);
  if (!column) return undefined;
  const left = new Set(without.values);
  return Uint8Array.from(column.values, (value) => Number(!left.has(value)));
}

/** 1 for each point that takes part. Null: all points do. */
export function partMask(cloud: Cloud, positions: Float32Array | Float64Array, part: Part): Uint8Array | null {
  const mask = classMask(cloud, part);
  const { box } = part;
  if (!box) return mask ?? null;
  const all = mask ?? new Uint8Array(cloud.count).fill(1);
  const [low, high] = box;
  for (let i = 0; i < positions.length; i++) {
    const [value, axis] = [positions[i]!, i % 3];
    if (value < low[axis]! || value > high[axis]!) all[(i - axis) / 3] = 0;
  }
  return all;
}
