// npm run figures: builds, then draws the paper's figures. Arguments choose some of them.
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
