import { mkdirSync, readFileSync, rmSync } from "node:fs";

import { inRoot } from "../lib/paths.js";
import { run } from "../lib/run.js";
import type { Outcome } from "./check.js";
import { counted } from "./check.js";

/** Runs the tests of one directory and takes the counts from vitest's own report. */
export async function vitest(directory: string, env: Record<string, string> = {}): Promise<Outcome> {
  const report = inRoot("target", "reports", `${directory.replace("/", "-")}.json`);
  mkdirSync(inRoot("target", "reports"), { recursive: true });
  rmSync(report, { force: true });
  const reporters = ["--reporter=default", "--reporter=json", `--outputFile.json=${report}`];
  const { ok } = await run("vitest", ["run", `${directory}/`, ...reporters], { show: "results", env });
  return counted(ok, countsIn(report));
}

function countsIn(report: string): Outcome {
  try {
    const counts = JSON.parse(readFileSync(report, "utf8")) as { numPassedTests: number; numFailedTests: number };
    return { passed: counts.numPassedTests, failed: counts.numFailedTests };
  } catch {
    // vitest did not get as far as a report.
    return { passed: 0, failed: 0 };
  }
}
