import { copyFileSync } from "node:fs";

import { inRoot } from "../lib/paths.js";
import { mustRun, say } from "../lib/run.js";
import { unlessUnchanged } from "../lib/stamp.js";
import { WASM_TARGET } from "../setup/rust.js";
import { optimize } from "./optimize.js";
import { wasmFlags } from "./wasm.js";

const FAILED = "The reader of E57 and LAZ could not be built";

/** In src/ts and in dist. It has no glue: its functions take and return numbers. */
export const FILES = "formats/files.wasm";

/** Compiles the reader of E57 and LAZ to a module of its own, beside the code that uses it. */
export async function buildFiles(): Promise<void> {
  const work = {
    name: "files",
    inputs: [
      "Cargo.toml",
      "Cargo.lock",
      "src/files",
      ...["files", "optimize", "panics", "wasm"].map((step) => `scripts/build/${step}.ts`),
      "package-lock.json",
    ],
    outputs: [`src/ts/${FILES}`],
  };
  const result = await unlessUnchanged(work, async () => {
    say("Building the reader of E57 and LAZ…");
    const folder = inRoot("target", "files");
    const args = [
      "build",
      "--locked",
      "--release",
      "--package",
      "hpr-files",
      "--target",
      WASM_TARGET,
      "--target-dir",
      folder,
    ];
    const env = { CARGO_PROFILE_RELEASE_OPT_LEVEL: "z", RUSTFLAGS: await wasmFlags() };
    await mustRun("cargo", args, FAILED, { env });
    const built = `${folder}/${WASM_TARGET}/release/hpr_files.wasm`;
    copyFileSync(built, inRoot("src/ts", FILES));
    await optimize(inRoot("src/ts", FILES), FAILED);
  });
  say(`Reader of E57 and LAZ: ${result}`);
}
