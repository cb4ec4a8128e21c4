import { copyFileSync, mkdirSync, rmSync, writeFileSync } from "node:fs";
import { dirname } from "node:path";

import { inRoot, TSC } from "../lib/paths.js";
import { mustRun, say } from "../lib/run.js";
import { unlessUnchanged } from "../lib/stamp.js";
import { bundleGlobal, EMBEDDED, embedWasm, embedWorker } from "./embed.js";
import { WASM_FILES } from "./wasm.js";

const GENERATED = [...WASM_FILES, ...EMBEDDED.map((file) => `wasm/${file}`)];

/** The script for pages without a bundler. */
const GLOBAL = "dist/hidden-point-removal.global.js";

/** Compiles the TypeScript to the modules of the npm package and types, in dist. */
export async function buildPackage(): Promise<void> {
  const work = {
    name: "package",
    inputs: ["src/ts", "tsconfig.base.json", "tsconfig.build.json", "package-lock.json", "scripts/build/embed.ts"],
    ignore: EMBEDDED.map((file) => `src/ts/wasm/${file}`),
    outputs: ["dist/index.js", "dist/worker-thread.js", GLOBAL, ...GENERATED.map((file) => `dist/${file}`)],
  };
  const result = await unlessUnchanged(work, async () => {
    say("Compiling the npm package…");
    // The folder is emptied first: a module whose source is gone must not stay.
    rmSync(inRoot("dist"), { recursive: true, force: true });
    embedWasm();
    const worker = await embedWorker();
    await mustRun(process.execPath, [TSC, "-p", "tsconfig.build.json"], "The npm package does not compile");
    for (const file of GENERATED) {
      mkdirSync(inRoot("dist", dirname(file)), { recursive: true });
      copyFileSync(inRoot("src/ts", file), inRoot("dist", file));
    }
    writeFileSync(inRoot("dist/worker-thread.js"), worker);
    writeFileSync(inRoot(GLOBAL), await bundleGlobal());
    // Only the script has it.
    for (const file of ["global.js", "global.d.ts"]) rmSync(inRoot("dist", file));
  });
  say(`npm package: ${result}`);
}
