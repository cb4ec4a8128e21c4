/** The files that can be opened, as people write their names. Each name is also the ending of such files. */
export const FORMATS = ["LAS", "LAZ", "E57", "PTX", "PLY", "PCD", "XYZ", "TXT", "CSV", "OBJ", "glTF", "GLB"] as const;

/** Other endings of such files: tables of numbers, mostly from scanners, and packed files. */
export const OTHER_ENDINGS = ["PTS", "ASC", "GZ"] as const;

/** In a sentence: "LAS, LAZ … glTF or GLB". */
export function listed(words: readonly string[], last: "and" | "or"): string {
  return `${words.slice(0, -1).join(", ")} ${last} ${words.at(-1)!}`;
}
