import { extname } from "node:path";

import { FORMATS } from "./formats/formats.js";
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
  camera: boolean;
  cameras: boolean;
  images: boolean;
  coverage: boolean;
}

/** What to write, by the option `--format` or the name of the output. */
export function chosenFormat(
  given: string | undefined,
  { input, output, camera, cameras, images, coverage }: Asked,
): OutputFormat {
  const format = (OUTPUT_FORMATS as readonly string[]).includes(given ?? "") ? (given as OutputFormat) : undefined;
  if (given !== undefined && format === undefined) {
    throw new UsageProblem(`--format needs one of ${OUTPUT_FORMATS.join(", ")}, not ${given}`);
  }
  const [is, wanted] = [input, output].map((name) => extname(name).toLowerCase()) as [string, string];
  if (given === undefined && wanted === VIS && cameras && !images && !coverage) return "vis";
  if (images ? given === undefined : format === "colors" || format === "vis") {
    const endings = format === "vis" ? [VIS] : [".ply", ...TEXT, NUMPY];
    if (output === "-" || endings.includes(wanted)) return format ?? "colors";
    throw new UsageProblem(`${output} must end with ${endings.join(", ")} for ${format ?? "colors"}`);
  }
  const isLike = FORMATS[is]!.written.includes(wanted);
  const chosen = format ?? (coverage ? "counts" : byEnding(wanted, isLike, output === "-", camera));
  if (output === "-") return chosen ?? "points";
  if (chosen === undefined || (chosen === "points" && !isLike)) {
    const like = FORMATS[is]!.written.join(", ");
    if (Object.hasOwn(FORMATS, wanted) && FORMATS[wanted] === FORMATS[is]) {
      throw new UsageProblem(`${output} must end with ${like}: such points are read from ${wanted}, but not written`);
    }
    throw new UsageProblem(
      chosen === undefined
        ? `${output} must end with ${like}, since formats are not converted; --format can name something else than points`
        : `${output} must end with ${like}: points are written in the format of ${input}`,
    );
  }
  if (chosen !== "points" && ![...TEXT, NUMPY].includes(wanted)) {
    throw new UsageProblem(`${output} must end with ${[...TEXT, NUMPY].join(", ")} for ${chosen}`);
  }
  return chosen;
}

function byEnding(ending: string, isLike: boolean, isStandard: boolean, camera: boolean): OutputFormat | undefined {
  if (camera && (isStandard || [".csv", ".txt", NUMPY].includes(ending))) return "pixels";
  if (isLike || isStandard) return "points";
  return ({ ".idx": "indices", ".mask": "mask", [NUMPY]: "mask" } as const)[ending];
}

/** Whether the numbers are written as a NumPy array instead of text. */
export function isNumpy(output: string): boolean {
  return extname(output).toLowerCase() === NUMPY;
}
