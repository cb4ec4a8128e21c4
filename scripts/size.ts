// npm run size: builds the wasm and prints the share of each part, and the largest functions.
import { readFileSync } from "node:fs";
import { gzipSync } from "node:zlib";

import { optimize } from "./build/optimize.js";
import { buildWasm } from "./build/wasm.js";
import { command } from "./lib/command.js";
import { inRoot } from "./lib/paths.js";
import { mustRun } from "./lib/run.js";
import { setUpForBuild } from "./setup/setup.js";
import { WASM_TARGET } from "./setup/rust.js";
import { largest, partsOf } from "./size/parts.js";
import { contentOf } from "./size/content.js";

const FAILED = "The WebAssembly module with names could not be made";

await command(async () => {
  await setUpForBuild();
  await buildWasm();
  const content = contentOf(readFileSync(await named()));
  const released = readFileSync(inRoot("src/ts/wasm/hpr_bg.wasm"));
  console.log(`${released.length} bytes, gzipped ${gzipSync(released, { level: 9 }).length}`);
  console.table(partsOf(content));
  for (const { name, bytes } of largest(content.functions, 40)) console.log(`${bytes.length}\t${name}`);
});

/** The module as released, but with the names of its functions. Returns its path. */
async function named(): Promise<string> {
  const compiled = inRoot("target", WASM_TARGET, "release", "hpr.wasm");
  const folder = inRoot("target", "size");
  const bindgen = ["--target", "bundler", "--keep-debug", "--out-name", "hpr", "--out-dir", folder, compiled];
  await mustRun("wasm-bindgen", bindgen, FAILED);
  const module = inRoot("target", "size", "hpr_bg.wasm");
  await optimize(module, FAILED, true);
  return module;
}
