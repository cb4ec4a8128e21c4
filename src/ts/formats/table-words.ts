// Splits the lines of a table into words, and reads numbers from words.
import { numberIn } from "./numbers.js";
import { trimmed, wordsOf } from "./text.js";
import { chosenAxes, type ChosenColumns } from "./axes.js";
import { FormatProblem, quoted } from "./problem.js";
import type { Axes } from "./rows.js";

export type Separator = ";" | "," | "\t" | " ";

const DECIMAL_COMMA = /^[-+]?(\d+,\d+|,\d+)(e[-+]?\d+)?$/i;
const MISSING = /^(|na|n\/a|#n\/a|null|none)$/i;
/** A word in quotation marks. In it, a separator is part of the word, and a doubled mark stands for one mark. */
const QUOTED = /^\s*"((?:[^"]|"")*)"\s*$/;

export function isComment(line: string): boolean {
  return line.startsWith("#") || line.startsWith("//");
}

/** The separator between the words of a trimmed line. Commas may be decimal commas: "1,5 2,5 3,5". */
export function separatorOf(line: string): Separator {
  const bare = line.replace(/"[^"]*"/g, '""');
  if (bare.includes(";")) return ";";
  if (bare.includes(",")) {
    const spaced = wordsOf(bare);
    const decimal = spaced.filter((word) => cell(word) !== undefined).length >= 3 && !/,(\s|$)/.test(bare);
    if (!decimal) return ",";
  }
  return " ";
}

/** The words of a trimmed line, without the quotation marks around them. Undefined if a mark has no end. */
export function split(line: string, separator: Separator): string[] | undefined {
  if (!line.includes('"')) {
    if (separator === " ") return wordsOf(line);
    return line.split(separator).map(trimmed);
  }
  const words: string[] = [];
  let [word, within] = ["", false];
  for (const char of line) {
    if (char === '"') within = !within;
    const blank = char === " " || char === "\t";
    if (within || !(char === separator || (separator === " " && blank))) {
      word += char;
    } else if (separator !== " " || word !== "") {
      words.push(word);
      word = "";
    }
  }
  if (within) return undefined;
  words.push(word);
  return words.map((each) => QUOTED.exec(each)?.[1]!.replaceAll('""', '"') ?? trimmed(each));
}

/** A number of a table, and its decimal separator if it has one. */
export interface Cell {
  value: number;
  decimal?: "." | ",";
}

/** Reads a word. A missing value is NaN. Returns undefined for any other word that is not a number. */
export function cell(word: string): Cell | undefined {
  const value = numberIn(word);
  if (value !== undefined) return { value, ...(word.includes(".") && !Number.isNaN(value) ? { decimal: "." } : {}) };
  if (DECIMAL_COMMA.test(word)) return { value: Number(word.replace(",", ".")), decimal: "," };
  return MISSING.test(word) ? { value: NaN } : undefined;
}

/** The names of x, y and z: the exact ones, other usual ones, and letters of surveyors. */
const CALLED = [
  [/^x$/, /^(px|pos_?x|x_?pos|points(_m_xyz)?:0|easting|east)$/, /^e$/],
  [/^y$/, /^(py|pos_?y|y_?pos|points(_m_xyz)?:1|northing|north)$/, /^n$/],
  [/^z$/, /^(pz|pos_?z|z_?pos|points(_m_xyz)?:2|elevation|elev|height|altitude|up)$/, /^h$/],
];
const LENGTH = /^[[(]?(m|mm|cm|dm|km|um|µm|ft|feet|foot|in|inch|inches|us-?ft|ftus|yd|met(er|re)s?)?[\])]?$/i;
const UNIT = /[[(]([^\])]*)[\])]$|[ _.-](m|mm|cm|km|ft|met(?:er|re)s?)$/i;

const DEGREES = [/^(lon|long|lng|longitude)([ _.-]?deg(rees)?)?$/, /^(lat|latitude)([ _.-]?deg(rees)?)?$/];

/**
 * The names in a line, in two forms: as they are written, and bare. A bare name is in lower case and
 * has no unit: "X [m]" and "x_m" become x.
 */
export interface Names {
  written: readonly string[];
  bare: readonly string[];
  separator: Separator;
}

/** @param separator the separator of the points, if it is known */
export function namesIn(line: string, separator?: Separator): Names {
  const text = line
    .replace(/^(#+|\/\/+)\s*/, "")
    .replace(/^(columns|fields|format)\s*[:=]\s*/i, "")
    .replace(/\s+(?=\[[^\]]*\]|\([^)]*\))/g, "");
  // If names have several words, tabs separate the names.
  const own = separatorOf(text);
  const tabs = own === " " && separator !== "," && separator !== ";" && text.includes("\t");
  const between = tabs ? "\t" : own;
  const written = split(text, between) ?? [];
  const bare = written.map((name) =>
    name
      .toLowerCase()
      .replace(/(\[[^\]]*\]|\([^)]*\))/g, "")
      .trim()
      .replace(/[ _.-]?coord(inate)?$/, "")
      .replace(/[ _.-](m|mm|cm|km|ft|met(er|re)s?)$/, ""),
  );
  return { written, bare, separator: between };
}

/** Finds the columns x, y and z by these names. Returns undefined if one of them is not found. */
export function axesIn({ written, bare }: Names, chosen?: ChosenColumns): Axes | undefined {
  if (chosen) return chosenAxes(written, chosen);
  const placesOf = (pattern: RegExp | undefined) =>
    bare.flatMap((name, column) => (pattern?.test(name) === true ? [column] : []));
  // If there are columns x, y and z, all other columns are ignored. Otherwise, only one column may
  // have a name for each axis.
  const found = [[0], [0, 1], [2], [0, 1, 2]]
    .map((kinds) => CALLED.map((patterns) => kinds.flatMap((kind) => placesOf(patterns[kind]))))
    .find((axes) => axes.every(({ length }) => length > 0));
  if (found === undefined) return undefined;
  const several = found.find(({ length }) => length > 1);
  if (several) {
    throw new FormatProblem(
      `its columns ${several.map((column) => column + 1).join(" and ")} are names of the same axis: ${quoted(written.join(" "))}`,
    );
  }
  const axes = found.flat() as unknown as Axes;
  checkUnits(axes.map((axis) => unitOf(written[axis]!)));
  return axes;
}

/** Whether there are columns of longitude and latitude. */
export function areDegrees({ bare }: Names): boolean {
  return DEGREES.every((pattern) => bare.some((name) => pattern.test(name)));
}

/** Whether a line below the names gives the units of x, y and z. */
export function areUnits(words: readonly string[], axes: Axes): boolean {
  const units = axes.map((axis) => words[axis] ?? "");
  if (!units.every((unit) => LENGTH.test(unit)) || units.every((unit) => unit === "")) return false;
  checkUnits(units.map((unit) => normal(unit.replace(/[[\]()]/g, ""))));
  return true;
}

function unitOf(name: string): string {
  const [, inBrackets, behind] = UNIT.exec(name.trim()) ?? [];
  return normal(inBrackets ?? behind ?? "");
}

function normal(unit: string): string {
  const lower = unit.trim().toLowerCase();
  return lower.replace(/^met(er|re)s?$/, "m").replace(/^(foot|feet)$/, "ft");
}

/** Refuses coordinates in different units: together they do not give a place. */
function checkUnits(units: readonly string[]): void {
  const given = [...new Set(units.filter((unit) => unit !== ""))];
  if (given.length > 1) throw new FormatProblem(`its x, y and z are in different units: ${quoted(given.join(" "))}`);
}
