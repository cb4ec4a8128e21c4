#!/usr/bin/env node
// npx hidden-point-removal: filters a file of points.
import { readFileSync } from "node:fs";
import { extname } from "node:path";

import { HprError } from "../base/errors.js";
import { WorkerPointCloud } from "../worker.js";
import { HELP, readArguments, type Settings, UsageProblem } from "./arguments.js";
import { FormatProblem } from "../formats/problem.js";
import { OutputProblem, readWhole, writeWhole } from "./files.js";
import { FORMATS } from "./formats/formats.js";
import { type PointFile, written } from "./formats/point-file.js";
import { Progress } from "./progress.js";

process.exitCode = await main(process.argv.slice(2));

async function main(args: string[]): Promise<number> {
  let settings: Settings | "help" | "version";
  try {
    settings = readArguments(args);
  } catch (error) {
    if (!(error instanceof UsageProblem)) throw error;
    console.error(`hidden-point-removal: ${error.message} (--help shows how)`);
    return 2;
  }
  if (settings === "help" || settings === "version") {
    process.stdout.write(settings === "help" ? HELP : `${version()}\n`);
    return 0;
  }
  const progress = new Progress(process.stderr);
  try {
    const summary = await filter(settings, progress);
    progress.done();
    console.error(summary);
    return 0;
  } catch (error) {
    progress.done();
    console.error(`hidden-point-removal: ${reason(settings.input, error)}`);
    return 1;
  }
}

async function filter(settings: Settings, progress: Progress): Promise<string> {
  const { input, output, viewpoint, exponent, columns } = settings;
  const bytes = await readWhole(input, (share) => {
    progress.show(0.2 * share, "reading");
  });
  progress.show(0.2, "understanding");
  const file = FORMATS[extname(input).toLowerCase()]!(bytes, columns);
  const { visible, length, skipped } = await ask(file, viewpoint, exponent, progress);
  progress.show(0.9, "writing");
  await writeWhole(output, written(file, visible));
  const notes = [
    ...(file.columns === undefined ? [] : [file.columns]),
    ...(skipped > 0 ? [`${skipped} without a position`] : []),
    ...(file.leftOut.length > 0 ? [`left out: ${file.leftOut.join(", ")}`] : []),
  ];
  return [`${visible.length} of ${length} points are visible`, ...notes].join("; ");
}

/** The cloud is in workers, so this thread can draw the progress, and large clouds use several cores. */
async function ask({ positions }: PointFile, viewpoint: number[], exponent: number | undefined, progress: Progress) {
  const onProgress = (share: number) => {
    progress.show(0.4 + 0.3 * share, "preparing");
  };
  const cloud = await WorkerPointCloud.create(positions, { nonFinite: "skip", transfer: true, onProgress });
  try {
    progress.show(0.7, "looking");
    const { indices } = await cloud.visibleFrom(viewpoint, { exponent });
    return { visible: indices, length: cloud.length, skipped: cloud.skipped };
  } finally {
    await cloud.dispose();
  }
}

function reason(input: string, error: unknown): string {
  if (error instanceof FormatProblem) return `${input} cannot be read: ${error.message}`;
  if (error instanceof HprError) return `${error.message} (${error.code})`;
  if (error instanceof OutputProblem) return error.message;
  // A message of the system contains the file's name already.
  return error instanceof Error ? error.message : String(error);
}

function version(): string {
  const text = readFileSync(new URL("../../package.json", import.meta.url), "utf8");
  return (JSON.parse(text) as { version: string }).version;
}
