// npm run build [-- package]: the npm package in dist, and the demo page in www/dist.
import { build } from "./build/build.js";
import { buildPackage } from "./build/package.js";
import { buildWasm } from "./build/wasm.js";
import { command } from "./lib/command.js";
import { Problem } from "./lib/run.js";
import { setUpForBuild } from "./setup/setup.js";

await command(async () => {
  const [part, ...more] = process.argv.slice(3);
  if ((part !== undefined && part !== "package") || more.length > 0) {
    throw new Problem("npm run build takes nothing, or: npm run build -- package");
  }
  await setUpForBuild();
  if (part === undefined) {
    await build();
  } else {
    await buildWasm();
    await buildPackage();
  }
});
