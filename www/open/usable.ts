import type { Cloud } from "../cloud/cloud.ts";
import type { LoadRequest } from "../loaders/index.ts";
import type { KnownSurface, Sample } from "../samples/samples.ts";
import { OWN_COLORS } from "../settings/settings.ts";
import { colorChoices } from "../view/colors.ts";

const NO_SURFACE = "A true surface is known only for samples, and for PLY and OBJ meshes that are shown whole.";

/**
 * The color if it suits this cloud, else the cloud's own colors. A color of the last cloud or of the address may not
 * suit this cloud. `asked`: then a sentence says so.
 */
export function usableColor(color: string, cloud: Cloud, asked: boolean): { color: string; notes: string[] } {
  if (colorChoices(cloud).some(({ value }) => value === color)) return { color, notes: [] };
  const notes = asked ? [`The cloud has no “${color}” to color by, so it has its usual colors.`] : [];
  return { color: OWN_COLORS, notes };
}

/**
 * The surface that the cloud was taken from, or a sentence if it is not known. The faces of the user's own mesh are
 * read again when they are needed.
 */
export function surfaceOf(request: LoadRequest, sample: Sample | null, isMesh = false): KnownSurface | string {
  if (isMesh && request.kind === "file") return { file: request.file };
  if (isMesh && request.kind === "url") return { file: request.url };
  return sample?.surface ?? NO_SURFACE;
}
