import type { Viewpoint } from "../../settings/settings.ts";

/** A place from which a scanner or a camera looks. */
export interface Station {
  name: string;
  at: Viewpoint;
}

/** More stations would make the list too long, and the colors too many to tell apart. */
export const MOST_STATIONS = 50;

/** Longer names are cut. */
export const LONGEST_NAME = 40;
