// npm run mutants -- rust [--in-diff FILE] [--file PATH]…, or
// npm run mutants -- typescript --mutate src/ts/follow/newest.ts --testFiles tests/package/follow.test.ts
// Changes one place of the code at a time and reports the changes that no test finds: cargo-mutants for the core,
// Stryker for TypeScript. All further arguments go to them. What the tests import from the package is mutated in dist.
import { existsSync } from "node:fs";
import { join } from "node:path";

import { command } from "./lib/command.js";
import { findOnPath, inRoot, toolsRoot } from "./lib/paths.js";
import { Problem, mustRun, say } from "./lib/run.js";
import { setUpLinker } from "./setup/linker.js";
import { setUpRust } from "./setup/rust.js";

const CARGO_MUTANTS = "27.1.0";
const STRYKER = "9.5.1";

await command(async () => {
  const [language, ...args] = process.argv.slice(3);
  if (language === "rust") await rust(args);
  else if (language === "typescript") await typescript(args);
  else throw new Problem("Say which code is to be changed: npm run mutants -- rust, or npm run mutants -- typescript.");
});

async function rust(args: string[]): Promise<void> {
  await setUpRust();
  await setUpLinker();
  if (findOnPath("cargo-mutants") === undefined) {
    say(`Building cargo-mutants ${CARGO_MUTANTS} (some minutes)…`);
    const folders = ["--root", toolsRoot, "--target-dir", join(toolsRoot, "mutants")];
    const what = ["install", "cargo-mutants", "--version", CARGO_MUTANTS, "--locked", "--debug", ...folders];
    await mustRun("cargo", what, "cargo-mutants could not be built", { env: { CARGO_PROFILE_DEV_DEBUG: "0" } });
  }
  await mustRun("cargo", ["mutants", "--output", inRoot("target"), ...args], "Some changes are found by no test");
}

/** Stryker is no development dependency, because it would bring 155 packages that `npm test` never uses. */
async function typescript(args: string[]): Promise<void> {
  const folder = join(toolsRoot, "stryker");
  if (!existsSync(folder)) {
    say(`Installing Stryker ${STRYKER}…`);
    const what = [`@stryker-mutator/core@${STRYKER}`, `@stryker-mutator/vitest-runner@${STRYKER}`];
    // Without its own Vitest, it finds the project's.
    const options = ["--no-save", "--no-package-lock", "--legacy-peer-deps", "--no-audit", "--no-fund"];
    await mustRun("npm", ["install", "--prefix", folder, ...options, ...what], "Stryker could not be installed");
  }
  await mustRun(join(folder, "node_modules/.bin/stryker"), ["run", ...args], "Stryker could not run");
}
