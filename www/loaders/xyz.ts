import type { BufferGeometry } from "three";
import { XYZLoader } from "three/addons/loaders/XYZLoader.js";
import type { LoadedCloud } from "../cloud.ts";
import { pointsOf } from "./geometry.ts";
import { checkPointCount } from "./limits.ts";
import { LoadProblem } from "./problem.ts";

/** How the lines of a table are to be read. */
interface Layout {
  separator: RegExp;
  decimalComma: boolean;
  position: number[];
  color: number[] | null;
  /** What turns a color into 0 … 255. */
  colorScale: number;
}

const NUMBER = /^[-+]?(\d+([.,]\d*)?|[.,]\d+)(e[-+]?\d+)?$/i;
const NO_NUMBER = /^([-+]?(nan|inf|infinity)(\(.*\))?|null|na|)$/i;
const COLUMN_NAMES: RegExp[][] = [
  [/^(x|px|easting|east)$/, /^(y|py|northing|north)$/, /^(z|pz|elevation|height|altitude)$/],
  [/^(r|red)$/, /^(g|green)$/, /^(b|blue)$/],
];
/** Enough lines to tell how a file is laid out. */
const LOOK_AT = 200;

/**
 * XYZLoader, behind a pass that makes "x y z" or "x y z r g b" of what is found out there: commas and semicolons, decimal
 * commas, a header line, a line with the number of points, comments, more columns than these.
 */
export function readXyz(name: string, text: string): LoadedCloud {
  const lines = text.split(/\r\n|\r|\n/);
  const { layout, first } = findLayout(name, lines);
  checkPointCount(name, lines.length - first);

  const rows: string[] = [];
  for (let i = first; i < lines.length; i++) {
    const line = lines[i]!.trim();
    if (line === "" || isComment(line)) continue;
    const words = split(line, layout);
    const row = layout.position.map((column) => coordinate(words[column]));
    if (row.includes(null)) {
      throw new LoadProblem(`${name} does not look like a point cloud: line ${i + 1} is not a point (“${line.slice(0, 40)}”).`);
    }
    if (layout.color) row.push(...layout.color.map((column) => String(Number(words[column]) * layout.colorScale)));
    rows.push(row.join(" "));
  }
  // The published types of this loader are of an older one, which had a callback.
  const loader = new XYZLoader() as unknown as { parse(text: string): BufferGeometry };
  return pointsOf(loader.parse(rows.join("\n")), "double");
}

function isComment(line: string): boolean {
  return line.startsWith("#") || line.startsWith("//");
}

/** The coordinate as XYZLoader reads it: a number, "nan" for one that is missing, or null for something else altogether. */
function coordinate(word: string | undefined): string | null {
  if (word === undefined) return null;
  if (NUMBER.test(word)) return word;
  return NO_NUMBER.test(word) ? "nan" : null;
}

function split(line: string, { separator, decimalComma }: Pick<Layout, "separator" | "decimalComma">): string[] {
  const words = line.split(separator).map((word) => word.trim().replace(/^"(.*)"$/, "$1"));
  return decimalComma ? words.map((word) => word.replace(",", ".")) : words;
}

function findLayout(name: string, lines: string[]): { layout: Layout; first: number } {
  let header = "";
  for (let i = 0; i < Math.min(lines.length, LOOK_AT); i++) {
    const line = lines[i]!.trim();
    if (line === "" || /^\d+$/.test(line)) continue;
    const writing = separators(line);
    const words = split(line, writing);
    const isPoint = words.length >= 3 && words.every((word) => NUMBER.test(word) || NO_NUMBER.test(word)) && words.some((word) => word !== "");
    if (isPoint || (header !== "" && words.filter((word) => NUMBER.test(word)).length >= 3)) {
      return { layout: columns(name, header, lines.slice(i, i + LOOK_AT), writing), first: i };
    }
    // One line of names may stand above the points; after a second line of words this is a text, not a table.
    if (!isComment(line) && header !== "" && !isComment(header)) break;
    header = line;
  }
  throw new LoadProblem(`${name} does not look like a point cloud: no lines of three numbers were found.`);
}

function separators(line: string): Pick<Layout, "separator" | "decimalComma"> {
  if (line.includes(";")) return { separator: /;/, decimalComma: true };
  const spaced = line.split(/\s+/);
  const decimals = spaced.length >= 3 && spaced.every((word) => NUMBER.test(word));
  if (line.includes(",") && !decimals) return { separator: /,/, decimalComma: false };
  return { separator: /\s+/, decimalComma: decimals };
}

function columns(name: string, header: string, lines: string[], writing: Pick<Layout, "separator" | "decimalComma">): Layout {
  const rows = lines.map((line) => line.trim()).filter((line) => line !== "" && !isComment(line)).map((line) => split(line, writing));
  const names = namesIn(header);
  const named = COLUMN_NAMES.map((patterns) => patterns.map((pattern) => names.findIndex((word) => pattern.test(word))));
  const unnamed = named[0]!.includes(-1);
  // A line of names without these among them: the first three columns may be anything.
  if (unnamed && !isComment(header) && names.length === rows[0]!.length && names.length > 3) {
    throw new LoadProblem(`${name} does not say which columns are x, y and z: its header is “${header.slice(0, 80)}”.`);
  }
  const position = unnamed ? [0, 1, 2] : named[0]!;

  let color = named[1]!.includes(-1) ? null : named[1]!;
  if (!color && !rows.some((row) => row.length !== rows[0]!.length)) {
    // Without names, the last three of 6 columns (x y z r g b) or 7 (with an intensity between) are colors if all are bytes.
    const width = rows[0]!.length;
    const last = [width - 3, width - 2, width - 1];
    if ((width === 6 || width === 7) && rows.every((row) => last.every((column) => isByte(row[column]!)))) color = last;
  }
  const largest = color ? Math.max(...rows.flatMap((row) => color.map((column) => Number(row[column])))) : 0;
  const colorScale = largest <= 1 ? 255 : largest > 255 ? 255 / 65535 : 1;
  return { ...writing, position, color: Number.isFinite(largest) ? color : null, colorScale };
}

/** The names in a header line, in lower case and without their units: “X [m]” and “x_m” are x. */
function namesIn(header: string): string[] {
  const bare = header.toLowerCase().replace(/^(#|\/\/)\s*/, "").replace(/\s*(\[[^\]]*\]|\([^)]*\))/g, "");
  return split(bare, separators(bare)).map((name) => name.replace(/[ _.-]?coord(inate)?$/, "").replace(/[ _.-](m|mm|cm|km|ft|met(er|re)s?)$/, ""));
}

function isByte(word: string): boolean {
  return /^\d{1,3}$/.test(word) && Number(word) <= 255;
}
