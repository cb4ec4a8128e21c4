// npm run docs: writes the API reference of both packages, from their doc comments.
import { buildPackage } from "./build/package.js";
import { buildWasm } from "./build/wasm.js";
import { command } from "./lib/command.js";
import { mustRun } from "./lib/run.js";
import { setUpForBuild } from "./setup/setup.js";

await command(async () => {
  await setUpForBuild();
  // The types of the wasm are generated.
  await buildWasm();
  await buildPackage();
  await mustRun("typedoc", [], "The reference of the npm package could not be built");
  await mustRun("cargo", ["doc", "--locked", "--no-deps"], "The reference of the crate could not be built");
  console.log("npm package: target/docs/npm/index.html\ncrate: target/doc/hidden_point_removal/index.html");
});
