// npm run fidelity: builds, then prints how often answers are wrong. `-- --real` scores labeled scans.
import { build } from "./build/build.js";
import { command } from "./lib/command.js";
import { runCompiled } from "./lib/compiled.js";
import { setUpForBuild } from "./setup/setup.js";

await command(async () => {
  await setUpForBuild();
  await build();
  await runCompiled("fidelity", {});
});
