import { copyFileSync, existsSync, mkdirSync, readdirSync } from "node:fs";
import { homedir } from "node:os";
import { join } from "node:path";

import { inRoot } from "../lib/paths.js";
import { mustRun, say } from "../lib/run.js";
import { unlessUnchanged } from "../lib/stamp.js";
import { WASM_TARGET } from "../setup/rust.js";
import { easeGlue } from "./glue.js";
import { optimize } from "./optimize.js";

const FAILED = "The WebAssembly module could not be built";

export const GLUE = ["hpr_bg.js", "hpr_bg.d.ts", "hpr_bg.wasm", "hpr_bg.wasm.d.ts"];

/** Compiles Rust to WebAssembly. Puts the module and its glue into src/ts/wasm, beside the code that uses them. */
export async function buildWasm(): Promise<void> {
  const work = {
    name: "wasm",
    inputs: [
      "Cargo.toml",
      "Cargo.lock",
      "src",
      "tools/wasm",
      "scripts/build/wasm.ts",
      "scripts/build/glue.ts",
      "scripts/build/optimize.ts",
      "scripts/build/panics.ts",
      "package-lock.json",
    ],
    ignore: ["src/ts", "tools/wasm/target"],
    outputs: GLUE.map((file) => `src/ts/wasm/${file}`),
  };
  const result = await unlessUnchanged(work, async () => {
    say("Building the WebAssembly module…");
    // bundler: this glue lets the package start the wasm itself, and start another copy
    // after a trap. No other glue does. hpr.js would start the wasm, so it is left out.
    // The types of hpr.js also fit hpr_bg.js.
    // no-install: wasm-pack would download tools. The project's tools are on the PATH.
    const args = [
      "--log-level",
      "error",
      "build",
      "src/cdylib",
      "--target",
      "bundler",
      "--release",
      "--mode",
      "no-install",
      "--no-pack",
    ];
    args.push("--out-dir", inRoot("target/wasm-pack"), "--out-name", "hpr", "--", "--locked");
    await mustRun("wasm-pack", args, FAILED, { env: { RUSTFLAGS: await flags() } });
    await optimize(inRoot("target/wasm-pack/hpr_bg.wasm"), FAILED);
    mkdirSync(inRoot("src/ts/wasm"), { recursive: true });
    for (const file of GLUE) {
      const built = file === "hpr_bg.d.ts" ? "hpr.d.ts" : file;
      copyFileSync(inRoot("target/wasm-pack", built), inRoot("src/ts/wasm", file));
    }
    easeGlue(inRoot("src/ts/wasm/hpr_bg.js"));
  });
  say(`WebAssembly module: ${result}`);
}

/**
 * Less than the usual limit of 225 to 325 for putting functions into their callers. Functions in the hot loops are
 * marked `#[inline]`, which keeps the usual limit for them.
 */
const SMALL = "-Cllvm-args=-inline-threshold=5";

/** Flags for rustc. The wasm contains the paths of crates. The flags make them, and so the bytes, equal everywhere. */
async function flags(): Promise<string> {
  await mustRun("cargo", ["fetch", "--locked", "--target", WASM_TARGET], FAILED);
  const sources = join(process.env["CARGO_HOME"] ?? join(homedir(), ".cargo"), "registry", "src");
  const registries = existsSync(sources) ? readdirSync(sources) : [];
  const remaps = registries.map((registry) => `--remap-path-prefix=${join(sources, registry)}=crates`);
  return [process.env["RUSTFLAGS"] ?? "", SMALL, ...remaps].join(" ").trim();
}
