// npm run build: the npm package in dist, the demo page in www/dist.
import { build } from "./build/build.js";
import { command } from "./lib/command.js";
import { setUpForBuild } from "./setup/setup.js";

await command(async () => {
  await setUpForBuild();
  await build();
});
