// npm run figures: builds, then draws the paper's figures. It also writes the fidelity tables
// to tests/figures and the accessibility report to docs. Arguments choose some of them.
import { build } from "./build/build.js";
import { command } from "./lib/command.js";
import { runCompiled } from "./lib/compiled.js";
import { setUpBrowser } from "./setup/browser.js";
import { setUpForBuild } from "./setup/setup.js";

await command(async () => {
  await setUpForBuild();
  await build();
  await runCompiled("figures", { HPR_CHROMIUM: await setUpBrowser() });
});
