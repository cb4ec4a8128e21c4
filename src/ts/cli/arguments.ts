import { parseArgs } from "node:util";

import { TRANSFER_FLAGS, VIEW_FLAGS } from "./flags.js";
import { HprError } from "../base/errors.js";
import type { ChosenColumns } from "../formats/axes.js";
import type { ImageSize } from "../files/read-cameras.js";
import { PointCloud } from "../index.js";
import { TRANSFER_ROWS, type TransferOptions } from "../query/option-rows.js";
import type { VisibilityOptions } from "../query/view-options.js";
import { MAX_WORKERS } from "../worker/team.js";
import { endingOf, FORMATS } from "./formats.js";
import { chosenFormat, type OutputFormat } from "./outputs.js";
import {
  oneOf,
  readColumns,
  readCount,
  readOption,
  readSize,
  readThreshold,
  readViewpoint,
  UsageProblem,
} from "./values.js";

function lines(flags: readonly (readonly [name: string, value: string, about: string])[]): string {
  return flags.map(([name, value, about]) => wrapped(`  --${name} ${value}`, about)).join("\n");
}

/** Both columns; no line is longer than 100 characters. */
function wrapped(left: string, right: string): string {
  return right
    .match(/.{1,76}(?: |$)/g)!
    .map((line, i) => (i === 0 ? left : "").padEnd(23) + line.trimEnd())
    .join("\n");
}

export const HELP = `Usage: hidden-point-removal IN --from X,Y,Z -o OUT [options]
       hidden-point-removal IN --cameras CAMERA.json --format pixels -o OUT.csv
       hidden-point-removal IN --viewpoints PLACES.csv [--coverage] -o OUT
       hidden-point-removal IN --images DIR --cameras FILE -o COLORED.ply

Writes those points of a file that can be seen, or their indices, a mask, their pixels
in an image, from how many places or by which cameras each point is seen, or its color.

  IN                   a LAS, LAZ, COPC, E57, PTX, PLY, PCD, XYZ, TXT, CSV, PTS, ASC, OBJ, GLTF,
                       GLB, NPY or BIN (KITTI, nuScenes, points3D of COLMAP) file, also packed (.gz)
  --columns X,Y,Z      which columns of IN are x, y and z: their names or numbers from 1

From where (one of the three, in the coordinates of the file):
  --from X,Y,Z         one viewpoint
  --viewpoints FILE    many viewpoints: a table with the columns x,y,z or name,x,y,z; or cameras
                       (a folder, or an ending .json, .yaml or .bin)
  --cameras FILE       one or many cameras: a JSON object with cameraToWorld, fx, fy, cx, cy, width,
                       height and, if needed, model, distortion, near, far, or a list of such, each
                       with the name of its "image"; COLMAP's folder with cameras and images;
                       transforms.json of nerfstudio; calib.txt of KITTI; YAML of OpenCV and ROS
  --size WxH           the size of their images in pixels, if the file does not say it
  --images DIR         with --cameras: the folder of their images. Each point gets the color
                       that the cameras see there (needs sharp: npm install sharp)
${lines(TRANSFER_FLAGS)}

How (the defaults fit most clouds):
${lines(VIEW_FLAGS)}
  --score-threshold T  with looks: the points whose score is at least T, from 0 to 1

What to write:
  -o, --output OUT     the file to write; - is standard output. With --viewpoints or --cameras, a
                       name with {name} in it is one file for each; without, OUT holds what any
                       of them sees
  --coverage           with --viewpoints or --cameras: how many of them see each point
  --format F           points (a file like IN, or PLY or LAS), indices, mask, scores (with looks), pixels
                       (index, u, v, depth; of one camera, or with {name}), counts (with --coverage), colors
                       (with --images: a PLY file of all points with their colors and "seen", the
                       number of cameras; or a table) or vis (with --cameras: COLMAP's file of
                       which images see each point, OUT.vis). The default follows from OUT: an
                       ending like IN's is points, .idx indices, .mask and .npy a mask
                       All but points are text, one line each, or NumPy arrays (.npy)
  --overwrite          OUT may be the same file as IN, CAMERA or PLACES
  --damaged            reads a file that contradicts itself, and says how
  --workers N          how many workers share many viewpoints, from 1 to 64; they change no answer. The
                       default is one for each core from 200,000 points on, but no more than hold
                       16 million points together, and 1 for smaller files
  --progress           reports the progress, also if standard error is not a terminal
  -h, --help           shows this
  --version            shows the version

Without --columns, the columns named x, y and z (or easting, northing and height) are
read. In a file without names, the first three columns are read. At the end, the command
says which columns it has read. A file that breaks the rules of its format is refused,
with the number of the line.

All values of a point (color, normal, any property) are copied unchanged. Of a PLY file,
only the vertices are kept. Compressed PCD data is written uncompressed, and LAZ and COPC
files are written as LAS. Points without a position (NaN) are never visible. Indices count
from 0, in the order of the file.

Exit codes: 0 done, 1 a file could not be read, written or understood, 2 wrong usage
`;

export interface Settings {
  input: string;
  /** The name of a file, or "-" for standard output. */
  output: string;
  format: OutputFormat;
  /** From where: a viewpoint, or the name of a file with viewpoints, or with cameras. */
  place: { viewpoint: number[] } | { viewpoints: string; each: boolean } | { cameras: string; each: boolean };
  /** The size of the cameras' images, if their file does not say it. */
  size: ImageSize | undefined;
  /** The folder of the cameras' images, and how their values become one. */
  images: ({ images: string } & Pick<TransferOptions, "merge" | "weights">) | undefined;
  options: VisibilityOptions;
  /** The least score of a point that counts as visible. Undefined for the answer's own choice. */
  threshold: number | undefined;
  /** Undefined for the columns that the file itself names. */
  columns: ChosenColumns | undefined;
  /** How many workers share the work. Without a number, the cloud's size decides. */
  workers: number | undefined;
  /** Whether the output may replace an input. */
  overwrite: boolean;
  /** Whether a file that contradicts itself is read. */
  damaged: boolean;
  /** Whether the progress is reported without a terminal, too. */
  progress: boolean;
}

/** In the name of the output: is replaced by the name of each viewpoint. */
export const NAME = "{name}";

export function readArguments(args: string[]): Settings | "help" | "version" {
  const { values, positionals } = parsed(args);
  if (values.help === true) return "help";
  if (values.version === true) return "version";
  const [input, ...others] = positionals;
  if (input === undefined) throw new UsageProblem("which file?");
  if (others.length > 0) throw new UsageProblem(`one file at a time, not also ${others.join(", ")}`);
  checkInput(input, values.columns !== undefined);
  const { output } = values;
  const given = (["from", "viewpoints", "cameras"] as const).filter((name) => values[name] !== undefined);
  if (given.length === 0) {
    throw new UsageProblem("--from X,Y,Z is needed: the viewpoint; or --viewpoints or --cameras FILE");
  }
  if (given.length > 1) throw new UsageProblem(`--${given.join(" and --")} exclude each other; give one of them`);
  if (output === undefined) throw new UsageProblem("-o OUT is needed: the file to write");
  const each = output.includes(NAME);
  const many = values.viewpoints ?? values.cameras;
  if (each && many === undefined) {
    throw new UsageProblem(`${NAME} in the name of the output needs --viewpoints or --cameras`);
  }

  const options = viewOptions(values);
  const threshold = values["score-threshold"] === undefined ? undefined : readThreshold(values["score-threshold"]);
  const isOne = values.from !== undefined || each;
  const format = chosenFormat(values.format, {
    input,
    output,
    cameras: values.cameras !== undefined,
    images: values.images !== undefined,
    coverage: values.coverage === true,
  });
  checkCompany({ format, options, threshold, isOne, each, values });
  if (threshold !== undefined || format === "scores") options.scores = true;
  return {
    input,
    output,
    format,
    place:
      values.from !== undefined
        ? { viewpoint: readViewpoint(values.from) }
        : values.cameras !== undefined
          ? { cameras: values.cameras, each }
          : { viewpoints: values.viewpoints!, each },
    size: values.size === undefined ? undefined : readSize(values.size),
    images:
      values.images === undefined
        ? undefined
        : {
            images: values.images,
            merge: oneOf("merge", values.merge, TRANSFER_ROWS.merge.words),
            weights: oneOf("weights", values.weights, TRANSFER_ROWS.weights.words),
          },
    options,
    threshold,
    columns: values.columns === undefined ? undefined : readColumns(values.columns),
    workers: values.workers === undefined ? undefined : readCount("workers", values.workers, MAX_WORKERS),
    overwrite: values.overwrite === true,
    damaged: values.damaged === true,
    progress: values.progress === true,
  };
}

const FLAGS = [...VIEW_FLAGS, ...TRANSFER_FLAGS];

type Values = ReturnType<typeof parsed>["values"];

function parsed(args: string[]) {
  const texts = FLAGS.map(([name]) => [name, { type: "string" }] as const);
  try {
    const found = parseArgs({
      tokens: true,
      args: args.flatMap(joinedToNegative(args)),
      allowPositionals: true,
      options: {
        ...(Object.fromEntries(texts) as Record<(typeof FLAGS)[number][0], { type: "string" }>),
        from: { type: "string" },
        viewpoints: { type: "string" },
        cameras: { type: "string" },
        images: { type: "string" },
        size: { type: "string" },
        output: { type: "string", short: "o" },
        format: { type: "string" },
        coverage: { type: "boolean" },
        "score-threshold": { type: "string" },
        workers: { type: "string" },
        columns: { type: "string" },
        overwrite: { type: "boolean" },
        damaged: { type: "boolean" },
        progress: { type: "boolean" },
        help: { type: "boolean", short: "h" },
        version: { type: "boolean" },
      },
    });
    const names = found.tokens.flatMap((token) => (token.kind === "option" ? token.name : []));
    const twice = names.find((name, i) => names.indexOf(name) !== i);
    if (twice === undefined) return found;
    const way = twice === "from" ? ": several viewpoints stand in a file, --viewpoints FILE" : "";
    throw new UsageProblem(`--${twice} is given twice${way}`);
  } catch (error) {
    // What follows the first sentence explains how such arguments are written in general.
    throw error instanceof UsageProblem ? error : new UsageProblem((error as Error).message.split(/\.\s|\n/, 1)[0]);
  }
}

/** parseArgs insists on `--from=-1,2,3`, so `--from -1,2,3` is changed to that. */
function joinedToNegative(args: string[]) {
  const isValue = (i: number) => /^--[a-z-]+$/.test(args[i - 1] ?? "") && /^-[\d.]/.test(args[i] ?? "");
  return (word: string, i: number): string[] => {
    if (isValue(i)) return [];
    return [isValue(i + 1) ? `${word}=${args[i + 1]!}` : word];
  };
}

function checkInput(input: string, hasColumns: boolean): void {
  const ending = endingOf(input);
  if (!Object.hasOwn(FORMATS, ending)) throw new UsageProblem(`${input} is none of ${Object.keys(FORMATS).join(", ")}`);
  if (hasColumns && !FORMATS[ending]!.hasColumns) {
    throw new UsageProblem(`--columns has no meaning for ${input}: the format says where x, y and z are`);
  }
}

/** The options of a view. What the library refuses is refused before a file is read. */
function viewOptions(values: Values): VisibilityOptions {
  const given = VIEW_FLAGS.map(([name]) => name).filter((name) => values[name] !== undefined);
  const options = Object.fromEntries(given.map((name) => [name, readOption(name, values[name]!)]));
  if (options["exponent"] === "auto") options["exponent"] = undefined;
  const isOperator = OPERATOR.some((name) => given.includes(name));
  options["looks"] ??= isOperator ? 0 : 3;
  if (options["looks"] === 0) options["looks"] = undefined;
  // `--exponent auto` says the same as no exponent, but it excludes the same options.
  const asked = given.includes("exponent") ? { ...options, exponent: options["exponent"] ?? 0 } : options;
  try {
    // A distance needs no viewpoint here, and no point is too far away.
    new PointCloud([0, 0, 0]).visibleFrom([0, 0, 0], asked);
  } catch (cause) {
    if (!(cause instanceof HprError)) throw cause;
    throw new UsageProblem(`--${cause.message.replace(/ and (?=\w+ exclude)/, " and --")}`, { cause });
  }
  return options;
}

/** They ask for one flip. */
const OPERATOR = ["radius", "exponent", "inversion"] as const;

interface Company {
  format: OutputFormat;
  options: VisibilityOptions;
  threshold: number | undefined;
  /** Whether each answer is of one viewpoint. */
  isOne: boolean;
  each: boolean;
  values: Values;
}

/** Refuses options that have no effect together. */
function checkCompany({ format, options, threshold, isOne, each, values }: Company): void {
  const needs = (is: boolean, what: string, company: string) => {
    if (!is) throw new UsageProblem(`${what} needs ${company}`);
  };
  const excludes = (is: boolean, what: string, other: string) => {
    if (is) throw new UsageProblem(`${what} cannot be combined with ${other}`);
  };
  const coverage = values.coverage === true;
  const many = values.viewpoints ?? values.cameras;
  needs(!coverage || many !== undefined, "--coverage", "--viewpoints FILE or --cameras FILE");
  needs(values.images === undefined || values.cameras !== undefined, "--images", "--cameras FILE");
  needs(values.size === undefined || values.cameras !== undefined, "--size", "--cameras FILE");
  for (const name of ["merge", "weights"] as const) {
    needs(values[name] === undefined || values.images !== undefined, `--${name}`, "--images DIR");
  }
  needs(format !== "colors" || values.images !== undefined, "--format colors", "--images DIR");
  excludes(values.images !== undefined && format !== "colors", "--images", `--format ${format}`);
  excludes(values.images !== undefined && coverage, "--images", "--coverage");
  needs(format !== "vis" || values.cameras !== undefined, "--format vis", "--cameras FILE");
  excludes(
    (format === "vis" || format === "colors") && each,
    `--format ${format}`,
    `${NAME} in the name of the output`,
  );
  excludes(coverage && each, "--coverage", `${NAME} in the name of the output`);
  excludes(coverage && format !== "counts", "--coverage", `--format ${format}`);
  needs(format !== "counts" || coverage, "--format counts", "--coverage");
  needs(format !== "pixels" || values.cameras !== undefined, "--format pixels", "--cameras FILE");
  const scored = threshold !== undefined ? "--score-threshold" : "--format scores";
  if (threshold === undefined && format !== "scores") return;
  needs(options.looks !== undefined, scored, "--looks 2 or 3");
  excludes(threshold !== undefined && format === "scores", scored, "--format scores, which writes all scores");
  excludes(values.cameras !== undefined, scored, "--cameras");
  needs(isOne, scored, `one viewpoint: --from X,Y,Z, or --viewpoints FILE with ${NAME} in the name of the output`);
}
