import { mkdirSync, copyFileSync, readdirSync, existsSync } from "node:fs";
import { homedir } from "node:os";
import { join } from "node:path";

import { inRoot } from "../lib/paths.js";
import { mustRun, say } from "../lib/run.js";
import { unlessUnchanged } from "../lib/stamp.js";
import { WASM_TARGET } from "../setup/rust.js";

export const GLUE = ["hpr_bg.js", "hpr_bg.d.ts", "hpr_bg.wasm", "hpr_bg.wasm.d.ts"];

const FAILED = "The WebAssembly module could not be built";
const COMPILED = `target/${WASM_TARGET}/release/hidden_point_removal.wasm`;
const BOUND = "target/wasm-bindgen";

/** Rust → WebAssembly and its glue, in src/ts/wasm beside the code that uses it. */
export async function buildWasm(): Promise<void> {
  const work = {
    name: "wasm",
    inputs: ["Cargo.toml", "Cargo.lock", "src", "tools/wasm", "scripts/build/wasm.ts", "package-lock.json"],
    ignore: ["src/ts", "tools/wasm/target"],
    outputs: GLUE.map((file) => `src/ts/wasm/${file}`),
  };
  const result = await unlessUnchanged(work, async () => {
    say("Building the WebAssembly module…");
    await compile();
    // bundler: only this glue leaves starting the wasm to its user, who can then start another copy
    // after a trap. hpr.js, which would start it, is left out; its types are those of hpr_bg.js.
    const output = ["--out-dir", BOUND, "--out-name", "hpr"];
    await mustRun("wasm-bindgen", [COMPILED, "--target", "bundler", "--typescript", ...output], FAILED);
    mkdirSync(inRoot("src/ts/wasm"), { recursive: true });
    for (const file of GLUE) {
      const bound = inRoot(BOUND, file === "hpr_bg.d.ts" ? "hpr.d.ts" : file);
      const target = inRoot("src/ts/wasm", file);
      if (file.endsWith(".wasm")) await shrink(bound, target);
      else copyFileSync(bound, target);
    }
  });
  say(`WebAssembly module: ${result}`);
}

/** The paths of crates are written into the wasm: the same on every machine, so that its bytes are, too. */
async function compile(): Promise<void> {
  await mustRun("cargo", ["fetch", "--locked", "--target", WASM_TARGET], FAILED);
  const sources = join(process.env["CARGO_HOME"] ?? join(homedir(), ".cargo"), "registry", "src");
  const registries = existsSync(sources) ? readdirSync(sources) : [];
  const flags = registries.map((registry) => `--remap-path-prefix=${join(sources, registry)}=crates`);
  const RUSTFLAGS = [process.env["RUSTFLAGS"] ?? "", ...flags].join(" ").trim();
  const args = ["build", "--locked", "--lib", "--release", "--target", WASM_TARGET, "--features", "wasm"];
  await mustRun("cargo", args, FAILED, { env: { RUSTFLAGS } });
}

/**
 * Optimizes for size once more. `--low-memory-unused`: nothing is at the lowest 1024 addresses but the
 * far end of the stack, so offsets may be folded into loads and stores.
 */
async function shrink(from: string, to: string): Promise<void> {
  await mustRun("wasm-opt", [from, "-o", to, "-Oz", "--low-memory-unused", "--converge"], FAILED);
}
