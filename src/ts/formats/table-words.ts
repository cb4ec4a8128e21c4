// How the lines of a table fall into words, and words into numbers.
import { numberIn } from "./numbers.js";
import { trimmed, wordsOf } from "./text.js";

export type Separator = ";" | "," | "\t" | " ";

const DECIMAL_COMMA = /^[-+]?(\d+,\d+|,\d+)(e[-+]?\d+)?$/i;
const MISSING = /^(|na|n\/a|#n\/a|null|none)$/i;
/** A word in quotation marks, within which separators and doubled marks are letters; or any other word. */
const QUOTED = /^\s*"((?:[^"]|"")*)"\s*$/;

export function isComment(line: string): boolean {
  return line.startsWith("#") || line.startsWith("//");
}

/** By what the words of a trimmed line are divided. Commas may be decimal ones: "1,5 2,5 3,5". */
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

/** The words of a trimmed line, without quotation marks around them; undefined if a mark has no end. */
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

/** A number of a table, and by what its decimals are divided if it has any. */
export interface Cell {
  value: number;
  decimal?: "." | ",";
}

/** NaN where a value is missing; undefined for any other word. */
export function cell(word: string): Cell | undefined {
  const value = numberIn(word);
  if (value !== undefined) return { value, ...(word.includes(".") && !Number.isNaN(value) ? { decimal: "." } : {}) };
  if (DECIMAL_COMMA.test(word)) return { value: Number(word.replace(",", ".")), decimal: "," };
  return MISSING.test(word) ? { value: NaN } : undefined;
}
