import { extname } from "node:path";

import { CONVERTED } from "./formats/convert.js";
import { endingOf, FORMATS, writtenAs } from "./formats/formats.js";
import { UsageProblem } from "./values.js";

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
