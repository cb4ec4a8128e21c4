// npm run bench: builds, then prints the benchmark tables. Arguments go to the benchmarks.
import { spawnSync } from "node:child_process";

import { build } from "./build/build.js";
import { command } from "./lib/command.js";
import { environment, inRoot, root } from "./lib/paths.js";
import { mustRun } from "./lib/run.js";
import { findBrowser } from "./setup/browser.js";
import { setUpForBuild } from "./setup/setup.js";

await command(async () => {
  await setUpForBuild();
  await build();
  await mustRun(
    "cargo",
    ["build", "--locked", "--release", "--package", "hpr-tests", "--bin", "bench_native"],
    "The native benchmark does not build",
  );
  await mustRun("tsc", ["-p", "tests/bench"], "The benchmarks do not compile");
  const args = [inRoot("target", "bench", "tests", "bench", "main.js"), ...process.argv.slice(3)];
  const browser = findBrowser();
  const env = environment(browser === undefined ? {} : { HPR_CHROMIUM: browser });
  const { status } = spawnSync(process.execPath, args, { cwd: root, env, stdio: "inherit" });
  process.exitCode = status ?? 1;
});
