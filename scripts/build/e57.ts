import { copyFileSync } from "node:fs";

import { inRoot } from "../lib/paths.js";
import { mustRun, say } from "../lib/run.js";
import { unlessUnchanged } from "../lib/stamp.js";
import { WASM_TARGET } from "../setup/rust.js";
import { optimize } from "./optimize.js";
import { wasmFlags } from "./wasm.js";

const FAILED = "The reader of E57 files could not be built";

/** In src/ts and in dist. It has no glue: its functions take and return numbers. */
export const E57 = "formats/e57/e57.wasm";

/** Compiles the reader of E57 files to a module of its own, beside the code that uses it. */
export async function buildE57(): Promise<void> {
  const work = {
    name: "e57",
    inputs: [
      "Cargo.lock",
      "src/e57",
      ...["e57", "optimize", "panics", "wasm"].map((step) => `scripts/build/${step}.ts`),
      "package-lock.json",
    ],
    outputs: [`src/ts/${E57}`],
  };
  const result = await unlessUnchanged(work, async () => {
    say("Building the reader of E57 files…");
    const folder = inRoot("target", "e57");
    const args = [
      "build",
      "--locked",
      "--release",
      "--package",
      "hpr-e57",
      "--target",
      WASM_TARGET,
      "--target-dir",
      folder,
    ];
    const env = { CARGO_PROFILE_RELEASE_OPT_LEVEL: "z", RUSTFLAGS: await wasmFlags() };
    await mustRun("cargo", args, FAILED, { env });
    const built = `${folder}/${WASM_TARGET}/release/hpr_e57.wasm`;
    copyFileSync(built, inRoot("src/ts", E57));
    await optimize(inRoot("src/ts", E57), FAILED);
  });
  say(`Reader of E57 files: ${result}`);
}
