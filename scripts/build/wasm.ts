import { copyFileSync, mkdirSync } from "node:fs";

import { inRoot } from "../lib/paths.js";
import { mustRun, say } from "../lib/run.js";
import { unlessUnchanged } from "../lib/stamp.js";

export const GLUE = ["hpr_bg.js", "hpr_bg.d.ts", "hpr_bg.wasm", "hpr_bg.wasm.d.ts"];

/** Rust → WebAssembly and its glue, in src/ts/wasm beside the code that uses it. */
export async function buildWasm(): Promise<void> {
  const work = {
    name: "wasm",
    inputs: ["Cargo.toml", "Cargo.lock", "src", "tools/wasm", "package-lock.json"],
    ignore: ["src/ts", "tools/wasm/target"],
    outputs: GLUE.map((file) => `src/ts/wasm/${file}`),
  };
  const result = await unlessUnchanged(work, async () => {
    say("Building the WebAssembly module…");
    // bundler: only this glue leaves starting the wasm to its user, who can then
    // start another copy after a trap. hpr.js, which would start it, is left out,
    // and its types are those of hpr_bg.js.
    // no-install: wasm-pack would download tools; ours are on the PATH, and
    // wasm-opt comes from the npm package binaryen.
    const args = [
      "--log-level",
      "error",
      "build",
      "--target",
      "bundler",
      "--release",
      "--mode",
      "no-install",
      "--no-pack",
    ];
    args.push("--out-dir", "target/wasm-pack", "--out-name", "hpr", "--", "--features", "wasm", "--locked");
    await mustRun("wasm-pack", args, "The WebAssembly module could not be built");
    mkdirSync(inRoot("src/ts/wasm"), { recursive: true });
    for (const file of GLUE) {
      const built = file === "hpr_bg.d.ts" ? "hpr.d.ts" : file;
      copyFileSync(inRoot("target/wasm-pack", built), inRoot("src/ts/wasm", file));
    }
  });
  say(`WebAssembly module: ${result}`);
}
