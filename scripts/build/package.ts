import { copyFileSync, mkdirSync, rmSync } from "node:fs";

import { inRoot } from "../lib/paths.js";
import { mustRun, say } from "../lib/run.js";
import { unlessUnchanged } from "../lib/stamp.js";
import { GLUE } from "./wasm.js";

/** TypeScript → the npm package's modules and types, in dist. */
export async function buildPackage(): Promise<void> {
  const work = {
    name: "package",
    inputs: ["src/ts", "tsconfig.base.json", "tsconfig.build.json", "package-lock.json"],
    outputs: ["dist/index.js", ...GLUE.map((file) => `dist/wasm/${file}`)],
  };
  const result = await unlessUnchanged(work, async () => {
    say("Compiling the npm package…");
    // Emptied first, so that no module outlives its source.
    rmSync(inRoot("dist"), { recursive: true, force: true });
    await mustRun("tsc", ["-p", "tsconfig.build.json"], "The npm package does not compile");
    mkdirSync(inRoot("dist/wasm"), { recursive: true });
    for (const file of GLUE) copyFileSync(inRoot("src/ts/wasm", file), inRoot("dist/wasm", file));
  });
  say(`npm package: ${result}`);
}
