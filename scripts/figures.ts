// npm run figures: builds, then draws the paper's figures. It also writes the fidelity tables
// to tests/figures and the accessibility report to docs. Arguments choose some of them.
import { spawnSync } from "node:child_process";

import { build } from "./build/build.js";
import { command } from "./lib/command.js";
import { environment, inRoot, root } from "./lib/paths.js";
import { mustRun } from "./lib/run.js";
import { setUpBrowser } from "./setup/browser.js";
import { setUpForBuild } from "./setup/setup.js";

await command(async () => {
  await setUpForBuild();
  await build();
  const env = environment({ HPR_CHROMIUM: await setUpBrowser() });
  await mustRun("tsc", ["-p", "tests/figures"], "The figures do not compile");
  const args = [inRoot("target", "figures", "tests", "figures", "main.js"), ...process.argv.slice(3)];
  const { status } = spawnSync(process.execPath, args, { cwd: root, env, stdio: "inherit" });
  process.exitCode = status ?? 1;
});
