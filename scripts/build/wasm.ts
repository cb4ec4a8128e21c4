import { copyFileSync, existsSync, mkdirSync, readdirSync } from "node:fs";
import { homedir } from "node:os";
import { join } from "node:path";

import { inRoot } from "../lib/paths.js";
import { mustRun, say } from "../lib/run.js";
import { unlessUnchanged } from "../lib/stamp.js";
import { WASM_TARGET } from "../setup/rust.js";
import { makeGlue, setUpWasmTools } from "../setup/tools.js";
import { easeGlue, numberImports } from "./glue.js";
import { optimize } from "./optimize.js";

const FAILED = "The WebAssembly module could not be built";

export const GLUE = ["hpr_bg.js", "hpr_bg.d.ts", "hpr_bg.wasm", "hpr_bg.wasm.d.ts"];

/** The modules, by their folder in src/ts and in dist, with their options for cargo. */
export const MODULES: Record<string, string[]> = { lite: ["--no-default-features"], wasm: [] };

/**
 * Saves 4.7 kB of 162 and 1.8 kB of 52. Views, drafts and sectors take as long as with level 3. The last pass over
 * everything has the level of `hpr`, in Cargo.toml.
 */
const LEVEL = { CARGO_PROFILE_RELEASE_OPT_LEVEL: "2" };

/** Compiles Rust to WebAssembly. Puts each module and its glue into src/ts, beside the code that uses them. */
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
    ignore: ["src/ts", "src/files", "tools/wasm/target"],
    outputs: Object.keys(MODULES).flatMap((folder) => GLUE.map((file) => `src/ts/${folder}/${file}`)),
  };
  const result = await unlessUnchanged(work, async () => {
    say("Building the WebAssembly modules…");
    for (const [folder, options] of Object.entries(MODULES)) await buildModule(folder, options);
  });
  say(`WebAssembly modules: ${result}`);
}

async function buildModule(folder: string, options: string[]): Promise<void> {
  const args = ["build", "--locked", "--release", "--package", "hpr", "--target", WASM_TARGET, ...options];
  const env = { ...LEVEL, RUSTFLAGS: await wasmFlags() };
  await Promise.all([setUpWasmTools(), mustRun("cargo", args, FAILED, { env })]);
  const out = inRoot("target/glue", folder);
  await makeGlue(inRoot("target", WASM_TARGET, "release/hpr.wasm"), out, FAILED);
  await optimize(join(out, "hpr_bg.wasm"), FAILED);
  mkdirSync(inRoot("src/ts", folder), { recursive: true });
  // hpr.js would start the wasm, so it is left out. Its types also fit hpr_bg.js.
  for (const file of GLUE) {
    const built = file === "hpr_bg.d.ts" ? "hpr.d.ts" : file;
    copyFileSync(join(out, built), inRoot("src/ts", folder, file));
  }
  const glue = inRoot("src/ts", folder, "hpr_bg.js");
  easeGlue(glue);
  numberImports([inRoot("src/ts", folder, "hpr_bg.wasm"), glue], glue);
}

const SMALL = [
  // Less than the usual limit of 225 to 325 for putting functions into their callers. Functions in the hot loops are
  // marked `#[inline]`, which keeps the usual limit for them.
  "inline-threshold=5",
  // Values larger than two numbers are copied by one instruction. Copies of options, views and errors, number by number,
  // would take 11 kB. Hot loops copy number by number (`one_by_one` in src/base/real.rs).
  ...["memcpy", "memmove", "memset"].map((copy) => `max-store-${copy}=2`),
].map((option) => `-Cllvm-args=-${option}`);

/** Flags for rustc. The wasm contains the paths of crates. The flags make them, and so the bytes, equal everywhere. */
export async function wasmFlags(): Promise<string> {
  await mustRun("cargo", ["fetch", "--locked", "--target", WASM_TARGET], FAILED);
  const sources = join(process.env["CARGO_HOME"] ?? join(homedir(), ".cargo"), "registry", "src");
  const registries = existsSync(sources) ? readdirSync(sources) : [];
  const remaps = registries.map((registry) => `--remap-path-prefix=${join(sources, registry)}=crates`);
  return [process.env["RUSTFLAGS"] ?? "", ...SMALL, ...remaps].join(" ").trim();
}
