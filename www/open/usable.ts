import type { Cloud } from "../cloud/cloud.ts";
import { OWN_COLORS } from "../settings/settings.ts";
import { colorChoices } from "../view/colors.ts";

/**
 * The color if it suits this cloud, else the cloud's own colors. A color of the last cloud or of the address may not
 * suit this cloud. `asked`: then a sentence says so.
 */
export function usableColor(color: string, cloud: Cloud, asked: boolean): { color: string; notes: string[] } {
  if (colorChoices(cloud).some(({ value }) => value === color)) return { color, notes: [] };
  const notes = asked ? [`The cloud has no “${color}” to color by, so it has its usual colors.`] : [];
  return { color: OWN_COLORS, notes };
}
