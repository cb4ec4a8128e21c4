import { TSC } from "../lib/paths.js";
import { setUpBrowser } from "../setup/browser.js";
import type { Check, Outcome } from "./check.js";
import { checkCommand, sum } from "./check.js";
import { BUILD } from "./build.js";
import { vitest } from "./vitest.js";

export const typescriptChecks: Check[] = [
  {
    title: "TypeScript: types",
    part: "types",
    needs: [BUILD],
    run: async () => {
      const outcomes: Outcome[] = [];
      // The scripts are compiled by their own rules before they run. So are the last three, whose imports need endings.
      for (const project of [".", "tests/bench", "tests/fidelity", "tests/figures"]) {
        outcomes.push(await checkCommand(process.execPath, [TSC, "-p", project, "--noEmit"]));
      }
      return sum(outcomes);
    },
  },
  {
    title: "TypeScript: lints",
    part: "lint",
    needs: [BUILD],
    run: () => checkCommand("oxlint", []),
  },
  {
    title: "TypeScript: imports go downward",
    // Needs the build, because the check also follows imports of the generated glue and of the built package.
    part: "lint",
    needs: [BUILD],
    run: () => checkCommand("depcruise", ["--config", ".dependency-cruiser.mjs", "src/ts", "www", "scripts", "tests"]),
  },
  {
    title: "TypeScript, CSS, HTML: formatting",
    part: "format",
    run: () => checkCommand("oxfmt", ["--check"]),
  },
  {
    title: "TypeScript: documentation",
    part: "docs",
    needs: [BUILD],
    // Every public name must be explained, and every link must have a target.
    run: () => checkCommand("typedoc", ["--logLevel", "Warn"]),
  },
  {
    title: "Commands",
    part: "scripts",
    run: () => vitest("tests/scripts"),
  },
];

export const packageCheck: Check = {
  title: "npm package, under Node",
  part: "package",
  needs: [BUILD],
  // Some of its tests run examples of the crate.
  locks: "fuzz",
  run: () => vitest("tests/package", { atOnce: 2 }),
};

export const pageCheck: Check = {
  title: "Demo page, in Chromium",
  part: "page",
  needs: [BUILD],
  // Each test file spends half of its time waiting for its browser.
  run: async () => vitest("tests/browser", { env: { HPR_CHROMIUM: await setUpBrowser() }, atOnce: 2 }),
};
