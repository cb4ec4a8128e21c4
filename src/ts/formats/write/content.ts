import type { CloudFile } from "../cloud-file.js";
import { displayColors, displayScale } from "../colors.js";
import type { FilledColumn, Values } from "../numbers.js";

/** Points, their numbers, and those that are to be written. */
export interface Content {
  positions: Float32Array | Float64Array;
  /** Three bytes for each point. */
  colors: Uint8Array | null;
  fields: readonly FilledColumn[];
  indices: Uint32Array;
}

/** The formats that clouds are written in. */
export type WrittenFormat = "ply" | "las";

/** The number of points that are written together. On a page, this takes less time than a frame. */
export const BATCH = 8192;

const CHANNELS = ["red", "green", "blue"];
const LARGEST = 65_535;

/**
 * The points as a format can hold them, and sentences about what is changed. Colors are bytes in PLY, and 16 bits in LAS.
 * An intensity is 16 bits in LAS. LAS has no points without a position.
 */
export function contentOf(
  { positions, columns, packed }: Pick<CloudFile, "positions" | "columns" | "packed">,
  format: WrittenFormat,
  indices: Uint32Array,
): { content: Content; notes: string[] } {
  const notes: string[] = [];
  const channels = CHANNELS.map((name) => columns.find((column) => column.name === name)?.values);
  const [red, green, blue] = channels;
  const own = red && green && blue ? ([red, green, blue] as const) : undefined;
  const others = columns.filter(({ name }) => !(own || packed) || !CHANNELS.includes(name));
  if (format === "ply") {
    const colors = packed ?? (own && (displayColors(own) ?? new Uint8Array(3 * own[0].length))) ?? null;
    const scale = own ? displayScale(own) : 1;
    const isByte = (value: number) => Math.abs(value * scale - Math.round(value * scale)) < 1e-3;
    const isCut = packed === undefined && own?.some((values) => !values.every(isByte)) === true;
    if (isCut) notes.push("colors are written as bytes");
    return { content: { positions, colors, fields: others, indices }, notes };
  }
  const fields = others.map((field) =>
    field.name.toLowerCase() === "intensity" ? scaledIntensity(field, notes) : field,
  );
  const there = indices.filter((i) => [0, 1, 2].every((axis) => Number.isFinite(positions[3 * i + axis])));
  if (there.length < indices.length) {
    notes.push(`${indices.length - there.length} points without a position are left out`);
  }
  const colored = own ? [...deepColors(own), ...fields] : fields;
  return { content: { positions, colors: own ? null : (packed ?? null), fields: colored, indices: there }, notes };
}

/** Colors in 16 bits. Those of other files are scaled, so that white stays white. */
function deepColors(channels: readonly [Values, Values, Values]): FilledColumn[] {
  const isDeep = channels.every((values) => values instanceof Uint16Array) && displayScale(channels) < 1;
  const scale = 257 * displayScale(channels);
  return channels.map((values, i) => ({
    name: CHANNELS[i]!,
    values: isDeep
      ? values
      : Uint16Array.from(values, (value) => Math.round(Math.min(LARGEST, Math.max(0, value * scale)))),
  }));
}

/** An intensity that is no whole number of 16 bits is scaled to them: a share of 1 by 65,535, others from the least to the largest. */
function scaledIntensity(field: FilledColumn, notes: string[]): FilledColumn {
  let [low, high, areWhole] = [Infinity, -Infinity, true];
  for (const value of field.values) {
    if (!Number.isFinite(value)) continue;
    if (value < low) low = value;
    if (value > high) high = value;
    if (!Number.isInteger(value)) areWhole = false;
  }
  const isShort = low >= 0 && high <= LARGEST;
  const areThere = field.values.every((value) => Number.isFinite(value));
  if (isShort && areWhole && areThere) return field;
  const [from, to] = isShort && areWhole ? [0, LARGEST] : low >= 0 && high <= 1 ? [0, 1] : [Math.min(low, 0), high];
  const scale = to > from ? LARGEST / (to - from) : 0;
  const values = Uint16Array.from(field.values, (value) =>
    Number.isFinite(value) ? Math.round((value - from) * scale) : 0,
  );
  if (scale !== 1) notes.push(`the intensity of ${from} to ${to} is scaled to 0 to 65535`);
  if (!areThere) notes.push("a missing intensity is 0");
  return { ...field, name: "intensity", values };
}
