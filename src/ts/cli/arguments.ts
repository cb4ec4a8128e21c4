import { parseArgs } from "node:util";

import { HprError } from "../base/errors.js";
import type { ChosenColumns } from "../formats/axes.js";
import { PointCloud } from "../index.js";
import { TRANSFER_ROWS, type TransferOptions } from "../query/option-rows.js";
import type { VisibilityOptions } from "../query/view-options.js";
import { MAX_WORKERS } from "../worker/workers.js";
import { endingOf, FORMATS } from "./formats/formats.js";
import { TRANSFER_FLAGS, VIEW_FLAGS } from "./flags.js";
import { chosenFormat, type OutputFormat } from "./outputs.js";
import { oneOf, readColumns, readCount, readOption, readThreshold, readViewpoint, UsageProblem } from "./values.js";

export interface Settings {
  input: string;
  /** The name of a file, or "-" for standard output. */
  output: string;
  format: OutputFormat;
  /** From where: a viewpoint, or the name of a file with viewpoints, or with cameras. */
  place: { viewpoint: number[] } | { viewpoints: string; each: boolean } | { cameras: string; each: boolean };
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
