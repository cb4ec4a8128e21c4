import type { LoadRequest } from "../loaders/index.ts";
import type { Sample } from "../samples/samples.ts";
import type { Cloud, Up } from "../cloud/cloud.ts";
import { OWN_COLORS, type Settings, USUAL_SETTINGS } from "../settings/settings.ts";
import { spreadOf } from "../cloud/prepare.ts";
import { colorChoices } from "../view/colors.ts";

/** Says which points may be left out when a file is read. */
export interface FileOptions {
  skipNonFinite: boolean;
  /** The largest number of points that are shown. */
  limit?: number;
}

/** Sample files lie beside the page, or beside the element's module. `base` is the address of that page or module. */
export function requestForSample({ label, from }: Sample, base: string): LoadRequest {
  return "file" in from
    ? { kind: "sample", name: label, url: new URL(from.file, base).href }
    : { kind: "shape", name: label, shape: from.generator };
}

/** A file on the web. A text that is not an address is kept unchanged: its download fails with a clear message. */
export function requestForAddress(text: string, options: FileOptions): LoadRequest {
  const url = addressOf(text);
  return { kind: "url", name: nameOf(text), url: url?.href ?? text, ...options };
}

/** The address as the page reads it. `null` for a text that is no address. */
export function addressOf(text: string): URL | null {
  return URL.canParse(text, document.baseURI) ? new URL(text, document.baseURI) : null;
}

/** The name of a file on the web, for use in a sentence. */
export function nameOf(text: string): string {
  return addressOf(text)?.pathname.split("/").pop() || text;
}

/**
 * The color if it suits this cloud, else the cloud's own colors. A color of the last cloud or of the address may not
 * suit this cloud. `asked`: then a sentence says so.
 */
export function usableColor(color: string, cloud: Cloud, asked: boolean): { color: string; notes: string[] } {
  if (colorChoices(cloud).some(({ value }) => value === color)) return { color, notes: [] };
  const notes = asked ? [`The cloud has no “${color}” to color by, so it has its usual colors.`] : [];
  return { color: OWN_COLORS, notes };
}

/** The usual settings for a cloud. `taken`: the direction that was up, if the file says so. */
export function usualLook(
  sample: Sample | null,
  name: string,
  taken: Up | undefined,
  cloud: Cloud,
): Pick<Settings, "size" | "fieldOfView" | "up"> {
  return {
    size: USUAL_SETTINGS.size,
    fieldOfView: sample?.fieldOfView ?? USUAL_SETTINGS.fieldOfView,
    up: sample?.up ?? taken ?? (isOnMap(cloud.center) ? "z" : (levelUp(cloud) ?? usualUp(name))),
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
  return /\.(ply|obj|gltf|glb)(\.gz)?$/i.test(name) ? "y" : "z";
}

/** Cells of this share of the cloud's diagonal are looked at from below. */
const CELL = 1 / 64;
/** Ground is level in this share of the cells, and this many times as large as what the other axis has. */
const LEVEL = 0.5;
const LARGER = 1.4;
const LOOKED_AT = 200_000;

/** The axis along which the cloud has level ground. `undefined`: neither, as with most things that are no place. */
function levelUp({ local, count }: Cloud): Up | undefined {
  const ends = [0, 1, 2].map((axis) => spreadOf(count, (i) => local[3 * i + axis]!));
  const cell = CELL * Math.hypot(...ends.map(([low, high]) => high - low));
  const [y, z] = [groundAlong(1), groundAlong(2)];
  if (y.share >= LEVEL && y.area > LARGER * z.area) return "y";
  return z.share >= LEVEL && z.area > LARGER * y.area ? "z" : undefined;

  /** How many cells have their lowest point at the most frequent height, and their share. */
  function groundAlong(axis: 1 | 2): { area: number; share: number } {
    const lowest = new Map<number, number>();
    for (let i = 0; i < count; i += Math.ceil(count / LOOKED_AT)) {
      const at = (of: number) => Math.floor((local[3 * i + of]! - ends[of]![0]) / cell);
      const place = at(0) * 4096 + at(3 - axis);
      const height = at(axis);
      if (height >= -1 && height < (lowest.get(place) ?? Infinity)) lowest.set(place, height);
    }
    const heights = new Map<number, number>();
    for (const height of lowest.values()) {
      for (const near of [height, height + 1]) heights.set(near, (heights.get(near) ?? 0) + 1);
    }
    const area = Math.max(0, ...heights.values());
    return { area, share: area / lowest.size };
  }
}
