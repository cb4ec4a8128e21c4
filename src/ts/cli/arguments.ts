import { extname } from "node:path";
import { parseArgs } from "node:util";

import { type ChosenColumns, isNumber } from "../formats/axes.js";
import { FORMATS } from "./formats/formats.js";

export const HELP = `Usage: hidden-point-removal IN --from X,Y,Z -o OUT [--exponent E|auto] [--columns X,Y,Z]

Writes those points of a file that can be seen from a viewpoint.

  IN                 a PLY, PCD, XYZ, TXT, CSV or PTS file
  --from X,Y,Z       the viewpoint, in the coordinates of the file
  -o, --output OUT   the file to write, in the format of IN; - is standard output
  --exponent E       R is the farthest distance times 10^E (0 or more); the larger, the
                     more points; auto, the default, derives it from the points' gaps
  --columns X,Y,Z    which columns of IN are x, y and z: their names or numbers from 1
  -h, --help         shows this
  --version          shows the version

Without --columns, the columns named x, y and z (or easting, northing and height) are
read. In a file without names, the first three columns are read. At the end, the command
says which columns it has read. A file that breaks the rules of its format is refused,
with the number of the line.

All values of a point (color, normal, any property) are copied unchanged. Of a PLY file,
only the vertices are kept. Compressed PCD data is written uncompressed. Points without a
position (NaN) are never visible.

Exit codes: 0 done, 1 a file could not be read, written or understood, 2 wrong usage
`;

export interface Settings {
  input: string;
  /** The name of a file, or "-" for standard output. */
  output: string;
  viewpoint: number[];
  /** Undefined for the automatic exponent. */
  exponent: number | undefined;
  /** Undefined for the columns that the file itself names. */
  columns: ChosenColumns | undefined;
}

/** Wrong usage: the message says what is wrong. */
export class UsageProblem extends Error {}

export function readArguments(args: string[]): Settings | "help" | "version" {
  const { values, positionals } = parsed(args);
  if (values.help === true) return "help";
  if (values.version === true) return "version";
  const [input, ...others] = positionals;
  if (input === undefined) throw new UsageProblem("which file?");
  if (others.length > 0) throw new UsageProblem(`one file at a time, not also ${others.join(", ")}`);
  if (values.from === undefined) throw new UsageProblem("--from X,Y,Z is needed: the viewpoint");
  if (values.output === undefined) throw new UsageProblem("-o OUT is needed: the file to write");
  const [is, wanted] = [input, values.output].map((name) => extname(name).toLowerCase());
  if (!Object.hasOwn(FORMATS, is!)) throw new UsageProblem(`${input} is none of ${Object.keys(FORMATS).join(", ")}`);
  if (values.output !== "-" && FORMATS[wanted!] !== FORMATS[is!]) {
    throw new UsageProblem(`${values.output} must be a ${is!} file like ${input}: formats are not converted`);
  }
  return {
    input,
    output: values.output,
    viewpoint: viewpoint(values.from),
    exponent: exponent(values.exponent ?? "auto"),
    columns: values.columns === undefined ? undefined : columns(values.columns),
  };
}

function parsed(args: string[]) {
  try {
    return parseArgs({
      args: args.flatMap(joinedToNegative(args)),
      allowPositionals: true,
      options: {
        from: { type: "string" },
        output: { type: "string", short: "o" },
        exponent: { type: "string" },
        columns: { type: "string" },
        help: { type: "boolean", short: "h" },
        version: { type: "boolean" },
      },
    });
  } catch (error) {
    // The lines after the first one explain how such arguments are written in general.
    throw new UsageProblem((error as Error).message.split("\n", 1)[0]);
  }
}

/** parseArgs insists on `--from=-1,2,3`, so `--from -1,2,3` is changed to that. */
function joinedToNegative(args: string[]) {
  const isValue = (i: number) => /^--(from|exponent)$/.test(args[i - 1] ?? "") && /^-[\d.]/.test(args[i] ?? "");
  return (word: string, i: number): string[] => {
    if (isValue(i)) return [];
    return [isValue(i + 1) ? `${word}=${args[i + 1]!}` : word];
  };
}

function viewpoint(text: string): number[] {
  const numbers = text.split(",").map((word) => (word.trim() === "" ? NaN : Number(word)));
  if (numbers.length !== 3 || !numbers.every(Number.isFinite)) {
    throw new UsageProblem(`--from needs three numbers, as in --from 1,2.5,-3, not ${text}`);
  }
  return numbers;
}

function exponent(text: string): number | undefined {
  if (text === "auto") return undefined;
  const value = text.trim() === "" ? NaN : Number(text);
  if (!(value >= 0 && Number.isFinite(value)))
    throw new UsageProblem(`--exponent needs a number of 0 or more, or auto, not ${text}`);
  return value;
}

function columns(text: string): ChosenColumns {
  const chosen = text.split(",").map((word) => word.trim());
  const isChoice = (word: string) => word !== "" && (isNumber(word) || !/^[-+]?\d+$/.test(word));
  if (chosen.length !== 3 || !chosen.every(isChoice) || new Set(chosen).size < 3)
    throw new UsageProblem(`--columns needs three different columns, as in --columns 2,3,4, not ${text}`);
  return chosen as unknown as ChosenColumns;
}
