// Splits the lines of a table into words, and reads numbers from words.
import { numberIn } from "./numbers.js";
import { trimmed, wordsOf } from "./text.js";

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
