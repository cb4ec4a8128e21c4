import { availableParallelism } from "node:os";

import { setUpBrowser } from "../setup/browser.js";
import type { Check, Outcome } from "./check.js";
import { checkCommand, sum } from "./check.js";
import { BUILD } from "./build.js";
import { vitest } from "./vitest.js";

export const typescriptChecks: Check[] = [
  {
    title: "TypeScript: types",
    needs: [BUILD],
    run: async () => {
      const outcomes: Outcome[] = [];
      for (const project of [".", "www", "www/offline", "scripts", "tests/bench", "tests/figures"]) {
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
    title: "TypeScript, CSS, HTML: formatting",
    run: () => checkCommand("prettier", ["--check", "."]),
  },
  {
    title: "TypeScript: documentation",
    needs: [BUILD],
    // Every name a user can write has to be explained, and every link to lead somewhere.
    run: () => checkCommand("typedoc", ["--logLevel", "Warn"]),
  },
  {
    title: "npm package, under Node",
    needs: [BUILD],
    run: () => vitest("tests/package"),
  },
];

export const pageCheck: Check = {
  title: "Demo page, in Chromium",
  needs: [BUILD],
  // Alone on the machine for most of it, and each file waits for its browser half of the time.
  run: async () =>
    vitest("tests/browser", { env: { HPR_CHROMIUM: await setUpBrowser() }, atOnce: availableParallelism() }),
};
