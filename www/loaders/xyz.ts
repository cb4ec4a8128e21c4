import type { LoadedCloud } from "../cloud/cloud.ts";
import { lines, type Reading } from "./blocks.ts";
import { CloudBuilder } from "./builder.ts";
import { LoadProblem } from "./problem.ts";

/** How the lines of a table are to be read. */
interface Layout {
  separator: RegExp;
  decimalComma: boolean;
  position: number[];
  others: { name: string; column: number }[];
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
 * A table of numbers as it is found out there: spaces, tabs, commas or semicolons, decimal commas, a line of names, a line
 * with the number of points, comments, any number of columns.
 */
export async function readXyz(reading: Reading, encoding: string): Promise<LoadedCloud> {
  const { name, limit } = reading;
  let found: { layout: Layout; first: number } | null = null;
  let builder: CloudBuilder | null = null;
  let number = 0;
  for await (const some of lines(reading, 0, encoding)) {
    found ??= findLayout(name, some);
    const { layout, first } = found;
    builder ??= new CloudBuilder(
      "float64",
      layout.others.map((column) => ({ name: column.name, type: "float32" })),
      limit,
      null,
    );
    for (const text of some) {
      const line = text.trim();
      if (number++ < first || line === "" || isComment(line) || !builder.takes()) continue;
      const words = split(line, layout);
      const [x, y, z] = layout.position.map((column) => coordinate(words[column]));
      if (x === null || y === null || z === null) {
        throw new LoadProblem(
          `${name} does not look like a point cloud: line ${number} is not a point (“${line.slice(0, 40)}”).`,
        );
      }
      const i = builder.put(x!, y!, z!);
      for (let k = 0; k < layout.others.length; k++)
        builder.values[k]![i] = coordinate(words[layout.others[k]!.column]) ?? NaN;
    }
  }
  return builder!.finish();
}

function isComment(line: string): boolean {
  return line.startsWith("#") || line.startsWith("//");
}

/** A number, NaN for one that is missing, or null for something else altogether. */
function coordinate(word: string | undefined): number | null {
  if (word === undefined) return null;
  if (NUMBER.test(word)) return Number(word);
  return NO_NUMBER.test(word) ? NaN : null;
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
    const isPoint =
      words.length >= 3 &&
      words.every((word) => NUMBER.test(word) || NO_NUMBER.test(word)) &&
      words.some((word) => word !== "");
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

function columns(
  name: string,
  header: string,
  lines: string[],
  writing: Pick<Layout, "separator" | "decimalComma">,
): Layout {
  const rows = lines
    .map((line) => line.trim())
    .filter((line) => line !== "" && !isComment(line))
    .map((line) => split(line, writing));
  const names = namesIn(header);
  const named = COLUMN_NAMES.map((patterns) =>
    patterns.map((pattern) => names.findIndex((word) => pattern.test(word))),
  );
  const unnamed = named[0]!.includes(-1);
  // A line of names without these among them: the first three columns may be anything.
  if (unnamed && !isComment(header) && names.length === rows[0]!.length && names.length > 3) {
    throw new LoadProblem(`${name} does not say which columns are x, y and z: its header is “${header.slice(0, 80)}”.`);
  }
  const position = unnamed ? [0, 1, 2] : named[0]!;
  return { ...writing, position, others: otherColumns(rows, position, unnamed ? [] : names, named[1]!) };
}

/** Colors by their names, or the last three of 6 columns (x y z r g b) or 7 (with an intensity between) if all are bytes; and what is named besides. */
function otherColumns(rows: string[][], position: number[], names: string[], color: number[]): Layout["others"] {
  const width = rows[0]!.length;
  const colored = !color.includes(-1);
  const last = [width - 3, width - 2, width - 1];
  const unnamed = names.length === 0 && !colored && (width === 6 || width === 7);
  const bytes = unnamed && rows.every((row) => row.length === width && last.every((column) => isByte(row[column]!)));
  const colors = colored ? color : bytes ? last : [];
  const others = colors.map((column, channel) => ({ name: ["red", "green", "blue"][channel]!, column }));
  for (let column = 0; column < width; column++) {
    if (position.includes(column) || colors.includes(column)) continue;
    const isNumber = rows.every((row) => NUMBER.test(row[column] ?? "") || NO_NUMBER.test(row[column] ?? ""));
    if (isNumber) others.push({ name: names[column] ?? `column ${column + 1}`, column });
  }
  return others;
}

/** The names in a header line, in lower case and without their units: “X [m]” and “x_m” are x. */
function namesIn(header: string): string[] {
  const bare = header
    .toLowerCase()
    .replace(/^(#|\/\/)\s*/, "")
    .replace(/\s*(\[[^\]]*\]|\([^)]*\))/g, "");
  return split(bare, separators(bare)).map((name) =>
    name.replace(/[ _.-]?coord(inate)?$/, "").replace(/[ _.-](m|mm|cm|km|ft|met(er|re)s?)$/, ""),
  );
}

function isByte(word: string): boolean {
  return /^\d{1,3}$/.test(word) && Number(word) <= 255;
}
