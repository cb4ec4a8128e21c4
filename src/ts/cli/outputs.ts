// Refuses outputs that would replace an input, or each other.
import { type BigIntStats, fstatSync } from "node:fs";
import { realpath, stat } from "node:fs/promises";
import { basename, dirname, extname, join, resolve } from "node:path";
import { linkedFrom, STANDARD_OUTPUT } from "./files.js";
import { UsageProblem } from "./values.js";
import { CONVERTED, endingOf, FORMATS, writtenAs } from "./formats.js";
import type { Answer } from "./ask.js";

interface Names {
  inputs: readonly string[];
  outputs: readonly string[];
  /** Whether an output may replace an input. */
  overwrite: boolean;
}

/** Two names stand for one file if its device and its number there are the same, so links count, too. */
export async function checkOutputs({ inputs, outputs, overwrite }: Names): Promise<void> {
  const read = new Map<string, string>();
  if (!overwrite) for (const name of inputs) read.set((await fileOf(name)) ?? "", name);
  const written = new Map<string, string>();
  for (const name of outputs) {
    const file = await fileOf(name);
    if (file === undefined) continue;
    const [input, other] = [read.get(file), written.get(file)];
    if (input !== undefined) {
      throw new UsageProblem(`${said(name)} is the same file as the input ${input}; --overwrite replaces it`);
    }
    if (other !== undefined) throw new UsageProblem(`${name} and ${other} are the same file`);
    written.set(file, name);
  }
}

/** The regular file that a name stands for, or the place where it will be made. Undefined for a pipe or a device. */
async function fileOf(name: string): Promise<string | undefined> {
  const place = name === "-" ? STANDARD_OUTPUT : await linkedFrom(name).catch(() => name);
  const found: BigIntStats | undefined =
    typeof place === "number"
      ? fstatSync(place, { bigint: true })
      : await stat(place, { bigint: true }).catch(() => undefined);
  if (found !== undefined) return found.isFile() ? `${found.dev}:${found.ino}` : undefined;
  const folder = await realpath(dirname(String(place))).catch(() => resolve(dirname(String(place))));
  return join(folder, basename(String(place)));
}

function said(output: string): string {
  return output === "-" ? "standard output" : output;
}

/** What the output holds. */
export const OUTPUT_FORMATS = ["points", "indices", "mask", "scores", "pixels", "counts", "colors", "vis"] as const;
export type OutputFormat = (typeof OUTPUT_FORMATS)[number];

/** The endings of files with one line for each number. */
const TEXT = [".txt", ".csv", ".idx", ".mask"];
const NUMPY = ".npy";
/** The ending of COLMAP's files that say which images see each point. */
const VIS = ".vis";

interface Asked {
  input: string;
  output: string;
  cameras: boolean;
  images: boolean;
  coverage: boolean;
}

/** What to write, by the option `--format` or the name of the output. */
export function chosenFormat(
  given: string | undefined,
  { input, output, cameras, images, coverage }: Asked,
): OutputFormat {
  const format = (OUTPUT_FORMATS as readonly string[]).includes(given ?? "") ? (given as OutputFormat) : undefined;
  if (given !== undefined && format === undefined) {
    throw new UsageProblem(`--format needs one of ${OUTPUT_FORMATS.join(", ")}, not ${given}`);
  }
  const [is, wanted] = [endingOf(input), extname(output).toLowerCase()];
  if (given === undefined && wanted === VIS && cameras && !images && !coverage) return "vis";
  if (images ? given === undefined : format === "colors" || format === "vis") {
    const endings = format === "vis" ? [VIS] : [".ply", ...TEXT, NUMPY];
    if (output === "-" || endings.includes(wanted)) return format ?? "colors";
    throw new UsageProblem(`${output} must end with ${endings.join(", ")} for ${format ?? "colors"}`);
  }
  const isLike = writtenAs(input, output) !== undefined;
  const chosen = format ?? (coverage ? "counts" : byEnding(wanted, isLike, output === "-"));
  if (output === "-") return chosen ?? "points";
  if (chosen === undefined || (chosen === "points" && !isLike)) {
    const like = [...new Set([...FORMATS[is]!.written, ...CONVERTED])].join(", ");
    throw new UsageProblem(
      Object.hasOwn(FORMATS, wanted)
        ? `${output} must end with ${like}: points of ${input} are not written to ${wanted}`
        : `${output} must end with ${like}${chosen === undefined ? "; --format can name something else than points" : ""}`,
    );
  }
  if (chosen !== "points" && ![...TEXT, NUMPY].includes(wanted)) {
    throw new UsageProblem(`${output} must end with ${[...TEXT, NUMPY].join(", ")} for ${chosen}`);
  }
  return chosen;
}

function byEnding(ending: string, isLike: boolean, isStandard: boolean): OutputFormat | undefined {
  if (isLike || isStandard) return "points";
  return ({ ".idx": "indices", ".mask": "mask", [NUMPY]: "mask" } as const)[ending];
}

/** Whether the numbers are written as a NumPy array instead of text. */
export function isNumpy(output: string): boolean {
  return extname(output).toLowerCase() === NUMPY;
}

type NumberList = Uint8Array | Uint32Array | Float32Array | Float64Array;

/** Numbers to write: one for each point, or a row for each visible point. */
interface Table {
  values: NumberList;
  /** The number of values in a row. */
  width: number;
  /** The names of the columns, if there are several. */
  names?: string;
  /** The type in NumPy's words. */
  type: string;
}

type NumberFormat = Exclude<OutputFormat, "points" | "vis">;

/** How many rows are made into one piece of text. */
const PIECE = 65_536;

/** The output with numbers instead of points. */
export function* numbersWritten(format: NumberFormat, answer: Answer, numpy: boolean): Generator<Uint8Array> {
  const { values, width, names, type } = tableOf(format, answer);
  const rows = values.length / width;
  if (numpy) {
    yield numpyHeader(type, names === undefined ? `(${rows},)` : `(${rows}, ${width})`);
    yield new Uint8Array(values.buffer, values.byteOffset, values.byteLength);
    return;
  }
  if (names !== undefined) yield Buffer.from(`${names}\n`);
  for (let row = 0; row < rows; row += PIECE) {
    let text = "";
    for (let i = row; i < Math.min(row + PIECE, rows); i++) {
      text += `${Array.from(values.subarray(i * width, (i + 1) * width), spelled).join(",")}\n`;
    }
    yield Buffer.from(text);
  }
}

function tableOf(format: NumberFormat, answer: Answer): Table {
  const { indices, length } = answer;
  switch (format) {
    case "indices":
      return { values: indices, width: 1, type: "<u4" };
    case "mask": {
      const mask = new Uint8Array(length);
      for (const index of indices) mask[index] = 1;
      // As a mask of NumPy: points[mask].
      return { values: mask, width: 1, type: "|b1" };
    }
    case "scores":
      return { values: answer.scores!, width: 1, type: "<f4" };
    case "counts":
      return { values: answer.counts!, width: 1, type: "<u4" };
    case "colors": {
      const { values, channels } = answer.colors!;
      const names =
        channels === 3 ? "red,green,blue" : Array.from({ length: channels }, (_, c) => `value${c + 1}`).join();
      return { values, width: channels, names, type: "<f4" };
    }
    case "pixels": {
      const { pixels, depths } = answer.image!;
      const rows = new Float64Array(4 * indices.length);
      indices.forEach((index, i) => {
        rows.set([index, pixels[2 * i]!, pixels[2 * i + 1]!, depths[i]!], 4 * i);
      });
      return { values: rows, width: 4, names: "index,u,v,depth", type: "<f8" };
    }
  }
}

/** Single precision has 9 digits. Whole numbers below 2³² keep all of theirs. */
function spelled(value: number): string {
  return Number.isInteger(value) ? String(value) : String(Number(value.toPrecision(9)));
}

/** NumPy's file format, version 1.0: the whole header has a multiple of 64 bytes. */
function numpyHeader(type: string, shape: string): Uint8Array {
  const text = `{'descr': '${type}', 'fortran_order': False, 'shape': ${shape}, }`;
  const length = Math.ceil((10 + text.length + 1) / 64) * 64 - 10;
  const header = Buffer.alloc(10 + length, " ");
  header.write("\x93NUMPY\x01\x00", 0, "latin1");
  header.writeUInt16LE(length, 8);
  header.write(text, 10, "latin1");
  header.write("\n", 10 + length - 1, "latin1");
  return header;
}
