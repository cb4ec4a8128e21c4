import type { Up } from "../cloud/cloud.ts";
import type { Sample } from "../samples/samples.ts";
import { type Settings, USUAL_SETTINGS } from "../settings/settings.ts";

/** Fewer points have a smaller size. With the size that closes a dense surface, a sparse surface looks scaly. */
const SIZES = [
  { below: 20_000, size: 1.4 },
  { below: 200_000, size: 2 },
];
const LARGE = 3;

/** The usual settings for a cloud. `taken`: the direction that was up, if the file says so. */
export function usualLook(
  sample: Sample | null,
  name: string,
  count: number,
  taken: Up | undefined,
): Pick<Settings, "size" | "fieldOfView" | "up"> {
  return {
    size: sample?.pointSize ?? SIZES.find(({ below }) => count < below)?.size ?? LARGE,
    fieldOfView: sample?.fieldOfView ?? USUAL_SETTINGS.fieldOfView,
    up: sample?.up ?? taken ?? usualUp(name),
  };
}

/** In files of scanners and surveyors z is up. In files of modelers y is up. */
function usualUp(name: string): Up {
  return /\.(ply|obj|gltf|glb)$/i.test(name) ? "y" : "z";
}
