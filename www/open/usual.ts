import type { Cloud, Up } from "../cloud/cloud.ts";
import type { Sample } from "../samples/samples.ts";
import { type Settings, USUAL_SETTINGS } from "../settings/settings.ts";

/**
 * The usual settings for a cloud. `taken`: the direction that was up, if the file says so. `center`: a place in the
 * middle of the cloud.
 */
export function usualLook(
  sample: Sample | null,
  name: string,
  taken: Up | undefined,
  center: Cloud["center"],
): Pick<Settings, "size" | "fieldOfView" | "up"> {
  return {
    size: USUAL_SETTINGS.size,
    fieldOfView: sample?.fieldOfView ?? USUAL_SETTINGS.fieldOfView,
    up: sample?.up ?? taken ?? (isOnMap(center) ? "z" : usualUp(name)),
  };
}

/**
 * Whether a place looks like easting, northing and height. Maps count meters or feet from far away: 500,000 and more to
 * the east in UTM, millions to the north. Heights are smaller.
 */
function isOnMap([x, y, z]: Cloud["center"]): boolean {
  const [less, more] = [Math.min(Math.abs(x), Math.abs(y)), Math.max(Math.abs(x), Math.abs(y))];
  return more >= 1e5 && less >= 1e3 && Math.abs(z) <= 0.1 * more;
}

/** In files of scanners and surveyors z is up. In files of modelers y is up. */
function usualUp(name: string): Up {
  return /\.(ply|obj|gltf|glb)$/i.test(name) ? "y" : "z";
}
