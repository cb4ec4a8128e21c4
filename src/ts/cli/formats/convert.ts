// Writes points in another format than the one they were read from.
import { byteColors } from "../../formats/colors.js";
import type { Content } from "../../formats/write/content.js";
import { finestScale, lasParts } from "../../formats/write/las.js";
import { plyParts } from "../../formats/write/ply.js";
import type { PointFile } from "./point-file.js";

/** The endings of files that the points of all formats can be written to. */
export const CONVERTED: readonly string[] = [".ply", ".las"];

/** The points in another format. */
export function converted(file: PointFile, indices: Uint32Array, ending: string): Iterable<Uint8Array> {
  const content = contentOf(file, indices);
  return ending === ".las" ? lasParts(content) : plyParts(content, file.crs ? [`CRS ${file.crs.name}`] : []);
}

/** In words: what a file in another format lacks. */
export function lost({ las, crs, leftOut = [], unread = [], positions }: PointFile, ending: string): string[] {
  const said = [...leftOut, ...unread];
  if (ending === ".las") return [...said, `digits of coordinates beyond ${finestScale(positions).scale[0]}`];
  if (crs) said.push(`the coordinate system, but for its name ${crs.name}`);
  if (las && las.records.length > 0) said.push(`${las.records.length} × record of LAS`);
  return said;
}

function contentOf({ positions, columns, packed }: PointFile, indices: Uint32Array): Content {
  const colors = packed ?? byteColors(columns);
  const isColor = (name: string) => /^(red|green|blue)$/.test(name);
  return { positions, colors, fields: columns.filter(({ name }) => !colors || !isColor(name)), indices };
}
