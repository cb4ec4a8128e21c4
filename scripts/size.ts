// npm run size: builds the wasm and writes the share of each part to docs/SIZE.md. Prints the largest functions.
import { readFileSync, writeFileSync } from "node:fs";
import { gzipSync } from "node:zlib";

import { optimize } from "./build/optimize.js";
import { buildWasm } from "./build/wasm.js";
import { command } from "./lib/command.js";
import { inRoot } from "./lib/paths.js";
import { mustRun } from "./lib/run.js";
import { setUpForBuild } from "./setup/setup.js";
import { WASM_TARGET } from "./setup/rust.js";
import { largest, type Part, partsOf } from "./size/parts.js";
import { contentOf } from "./size/content.js";

const RESULT = "docs/SIZE.md";
const FAILED = "The WebAssembly module with names could not be made";

await command(async () => {
  await setUpForBuild();
  await buildWasm();
  const content = contentOf(readFileSync(await named()));
  const released = readFileSync(inRoot("src/ts/wasm/hpr_bg.wasm"));
  writeFileSync(inRoot(RESULT), document(released, partsOf(content)));
  for (const { name, bytes } of largest(content.functions, 40)) console.log(`${bytes.length}\t${name}`);
  console.log(RESULT);
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

function document(released: Uint8Array, parts: Part[]): string {
  const number = (value: number) => value.toLocaleString("en");
  const rows = parts.map(({ name, bytes, gzipped }) => `| ${name} | ${number(bytes)} | ${number(gzipped)} |`);
  return `# The size of the wasm, part by part

Written by \`npm run size\`. The released module has ${number(released.length)} bytes, gzipped ${number(gzipSync(released, { level: 9 }).length)}.

The compiler puts small functions into their callers. Their bytes count for the caller. "Gzipped" tells by how many bytes
the gzipped module would shrink without the part; parts resemble each other, so these numbers add up to less than the whole.

| part | bytes | gzipped |
|---|---:|---:|
${rows.join("\n")}
`;
}
