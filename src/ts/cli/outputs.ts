// Refuses outputs that would replace an input, or each other.
import { type BigIntStats, fstatSync } from "node:fs";
import { realpath, stat } from "node:fs/promises";
import { basename, dirname, join, resolve, extname } from "node:path";
import { linkedFrom, STANDARD_OUTPUT } from "./files.js";
import { UsageProblem } from "./values.js";
import { CONVERTED, endingOf, FORMATS, writtenAs } from "./formats.js";

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
