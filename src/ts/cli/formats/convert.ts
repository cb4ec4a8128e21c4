// Writes points in another format than the one they were read from.
import { contentOf, type WrittenFormat } from "../../formats/write/content.js";
import { finestScale, lasParts } from "../../formats/write/las.js";
import { plyParts } from "../../formats/write/ply.js";
import type { PointFile } from "./frames.js";
import type { Transferred } from "../../cloud/transfer.js";

/** The endings of files that the points of all formats can be written to. */
export const CONVERTED: readonly string[] = [".ply", ".las"];

/** The points in another format, and what is changed. */
export function converted(
  file: PointFile,
  indices: Uint32Array,
  ending: string,
): { parts: Iterable<Uint8Array>; notes: string[] } {
  const format = ending.slice(1) as WrittenFormat;
  const { content, notes } = contentOf(file, format, indices);
  const comments = file.crs ? [`CRS ${file.crs.name}`] : [];
  return { parts: format === "las" ? lasParts(content) : plyParts(content, comments), notes };
}

/** In words: what a file in another format lacks. */
export function lost({ las, crs, leftOut = [], unread = [], positions }: PointFile, ending: string): string[] {
  const said = [...leftOut, ...unread];
  if (ending === ".las") {
    const scale = finestScale(positions).scale[0];
    // A number near enough that its decimal digits are the same.
    const isKept = (value: number) =>
      !(Math.abs(Math.round(value / scale) * scale - value) > 4 * Number.EPSILON * Math.abs(value));
    return positions.every(isKept) ? said : [...said, `digits of coordinates beyond ${scale}`];
  }
  if (crs) said.push(`the coordinate system, but for its name ${crs.name}`);
  if (las && las.records.length > 0) said.push(`${las.records.length} × record of LAS`);
  return said;
}

/**
 * A binary PLY file of all points in their order, each with its color, or its value if there is one channel, and with the
 * number of cameras that see it. What no camera sees is black, or NaN, and its `seen` is 0.
 */
export function coloredPly(
  positions: Float32Array | Float64Array,
  { values, channels, seen }: Transferred,
): Iterable<Uint8Array> {
  const isColor = channels >= 3;
  return plyParts({
    positions,
    colors: isColor
      ? new Uint8Array(3 * seen.length).map((_, i) => Math.round(values[channels * Math.floor(i / 3) + (i % 3)]! || 0))
      : null,
    fields: [...(isColor ? [] : [{ name: "value", values }]), { name: "seen", values: seen }],
    indices: new Uint32Array(seen.length).map((_, i) => i),
  });
}
