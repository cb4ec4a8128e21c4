import { mkdirSync, readFileSync, rmSync } from "node:fs";

import { inRoot } from "../lib/paths.js";
import { run } from "../lib/run.js";
import { setUpBrowser } from "../setup/browser.js";
import type { Check, Outcome } from "./check.js";
import { checkCommand, counted, sum } from "./check.js";
import { BUILD } from "./build.js";

export const typescriptChecks: Check[] = [
  {
    title: "TypeScript: types",
    needs: [BUILD],
    run: async () => {
      const outcomes: Outcome[] = [];
      for (const project of [".", "www", "scripts", "tests/bench", "tests/figures"]) {
        outcomes.push(await checkCommand("tsc", ["-p", project, "--noEmit"]));
      }
      return sum(outcomes);
    },
  },
  {
    title: "TypeScript: lints",
    needs: [BUILD],
    run: () => checkCommand("eslint", ["--max-warnings", "0", "."]),
  },
  {
    title: "npm package, under Node",
    needs: [BUILD],
    run: () => vitest("tests/package"),
  },
  {
    title: "Demo page, in Chromium",
    needs: [BUILD],
    run: async () => vitest("tests/browser", { HPR_CHROMIUM: await setUpBrowser() }),
  },
];

/** Runs the tests of one directory and takes the counts from vitest's own report. */
async function vitest(directory: string, env: Record<string, string> = {}): Promise<Outcome> {
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
