import type { Attribute, Field, LoadedCloud, Values } from "../cloud/cloud.ts";
import type { CloudFile, Reading } from "../../src/ts/formats/cloud-file.js";
import { displayColors } from "../../src/ts/formats/colors.js";

/** The file to read, the largest number of points to keep, and the listener for the progress. */
export interface Loading extends Pick<Reading, "name" | "onProgress" | "beside"> {
  blob: Blob;
  limit: number;
  damaged?: boolean | undefined;
  chosen?: Reading["chosen"];
}

const MOST_DECIMALS = 12;

/** What the page keeps of a file. */
export function loaded(name: string, file: CloudFile): LoadedCloud {
  const { positions, notes, axes, areAxesPlain, columnsAt, isGrid, up, stations, crs, las } = file;
  const { facts, ...known } = attributesOf(file);
  return {
    positions,
    ...known,
    facts: { ...facts, ...(las && { las, ...decimalsOf(las) }), ...(crs && { crs }) },
    notes: [...(axes !== undefined && areAxesPlain === false ? [`${name}: ${axes}.`] : []), ...notes.map(sentence)],
    ...(columnsAt && areAxesPlain === false && { columnsAt }),
    ...(isGrid && { isGrid }),
    ...((up ?? stations) && { taken: { ...(up && { up }), ...(stations && { stations }) } }),
  };
}

function sentence(note: string): string {
  return `${note[0]!.toUpperCase()}${note.slice(1)}.`;
}

/** The decimals that every coordinate has: those of the scale and of the offset. */
export function decimalsOf({
  scale,
  offset,
}: Record<"scale" | "offset", readonly number[]>): { decimals: [number, number, number] } | Record<string, never> {
  const decimals = scale.map((step, axis) => Math.max(decimalsIn(step), decimalsIn(offset[axis]!)));
  // A scale such as 1/3 has no end. Then the coordinates are shown with all digits.
  return decimals.every((count) => count <= MOST_DECIMALS) ? { decimals: decimals as [number, number, number] } : {};
}

function decimalsIn(value: number): number {
  const [digits, exponent = "0"] = String(Math.abs(value)).split("e");
  return Math.max(0, (digits!.split(".")[1]?.length ?? 0) - Number(exponent));
}

/** More attributes would make the choice of colors too long. */
const MOST_ATTRIBUTES = 8;
/** More bytes for each point are not worth their memory. */
const MOST_BYTES = 64;
const MOST_CATEGORIES = 64;

/** Columns that make no useful colors: normals, opacities and the parameters of splats. */
const NOT_FOR_EYES =
  /^(n[xyz]|normal_?[xyz]|scalar_n[xyz]|a|alpha|opacity|f_(dc|rest)_\d+|rot_\d+|scale_\d+|padding|_)$/i;
const CATEGORY = /class|label|segment|cluster|category|return|source|ring|object|instance/i;

/** Returns the colors in the columns of a file, all columns, and the attributes by which its points can be colored. */
export function attributesOf({
  columns,
  packed,
}: Pick<CloudFile, "columns" | "packed">): Pick<LoadedCloud, "colors" | "attributes" | "fields" | "facts"> {
  const named = (name: string) => columns.find((column) => column.name === name)?.values;
  const [red, green, blue] = [named("red"), named("green"), named("blue")];
  const attributes: Attribute[] = [];
  for (const { name, values, isDetail, labels } of columns) {
    if (isDetail) continue;
    if (attributes.length === MOST_ATTRIBUTES) break;
    if (/^(red|green|blue)$/.test(name) || NOT_FOR_EYES.test(name) || isConstant(values)) continue;
    attributes.push({
      name,
      kind: isCategory(name, values) ? "category" : "scalar",
      values,
      ...(labels && { labels }),
    });
  }
  const colors = packed ?? (red && green && blue ? displayColors([red, green, blue]) : null);
  // Colors in bytes are kept as colors. In 16 bits they have more digits than a screen can show.
  const fields = columns.filter(
    ({ name, values }) => !(/^(red|green|blue)$/.test(name) && colors && !(values instanceof Uint16Array)),
  );
  return { colors, attributes, ...keptFields(fields) };
}

/** Keeps as many columns as fit. A column with the same number everywhere becomes one number. */
function keptFields(columns: CloudFile["columns"]): Pick<LoadedCloud, "fields" | "facts"> {
  const fields: Field[] = [];
  let bytes = 0;
  for (const { name, values, labels } of columns) {
    const same = isConstant(values);
    if (!same) bytes += values.BYTES_PER_ELEMENT;
    if (bytes <= MOST_BYTES) {
      fields.push({ name, values: same ? values.slice(0, 1) : values, ...(labels && { labels }) });
    } else {
      bytes -= values.BYTES_PER_ELEMENT;
    }
  }
  const dropped = columns.length - fields.length;
  return { fields, ...(dropped > 0 ? { facts: { dropped } } : {}) };
}

function isConstant(values: Values): boolean {
  for (const value of values) if (value !== values[0]) return false;
  return true;
}

/** Whether a column is a category: its name says so, and it has few values, all of them integers. */
function isCategory(name: string, values: Values): boolean {
  if (!CATEGORY.test(name)) return false;
  const seen = new Set<number>();
  const whole = !(values instanceof Float32Array || values instanceof Float64Array);
  for (const value of values) {
    if (!whole && !Number.isInteger(value)) return false;
    seen.add(value);
    if (seen.size > MOST_CATEGORIES) return false;
  }
  return true;
}
