import { mkdirSync, readFileSync, rmSync } from "node:fs";
import { relative } from "node:path";
import { stripVTControlCharacters } from "node:util";

import { inRoot, root } from "../lib/paths.js";
import { run } from "../lib/run.js";
import type { Outcome } from "./check.js";
import { counted } from "./check.js";

interface Options {
  env?: Record<string, string>;
  /** How many files run at once. By default vitest keeps one core for itself. */
  atOnce?: number;
}

/** Runs the tests of one directory and reads the counts from vitest's report. */
export async function vitest(directory: string, { env = {}, atOnce }: Options = {}): Promise<Outcome> {
  const report = inRoot("target", "reports", `${directory.replace("/", "-")}.json`);
  mkdirSync(inRoot("target", "reports"), { recursive: true });
  rmSync(report, { force: true });
  const reporters = ["--reporter=default", "--reporter=json", `--outputFile.json=${report}`];
  const workers = atOnce === undefined ? [] : [`--maxWorkers=${atOnce}`];
  const { ok } = await run("vitest", ["run", `${directory}/`, ...reporters, ...workers], { show: "results", env });
  return counted(ok, countsIn(report));
}

interface Report {
  numPassedTests: number;
  numFailedTests: number;
  testResults: { name: string; message: string; assertionResults: Assertion[] }[];
}

interface Assertion {
  fullName: string;
  status: string;
  failureMessages: string[];
}

function countsIn(file: string): Outcome {
  try {
    const report = JSON.parse(readFileSync(file, "utf8")) as Report;
    return { passed: report.numPassedTests, failed: report.numFailedTests, failures: failuresIn(report) };
  } catch {
    // vitest ended without a report.
    return { passed: 0, failed: 0 };
  }
}

function failuresIn({ testResults }: Report): string[] {
  return testResults.flatMap(({ name, message, assertionResults }) => {
    const file = relative(root, name);
    const failed = assertionResults.filter(({ status }) => status === "failed");
    const lines = failed.map(({ fullName, failureMessages: [why = ""] }) => `${file} > ${fullName}: ${firstLine(why)}`);
    return message === "" ? lines : [...lines, `${file}: ${firstLine(message)}`];
  });
}

function firstLine(message: string): string {
  return stripVTControlCharacters(message).split("\n", 1)[0]!;
}
