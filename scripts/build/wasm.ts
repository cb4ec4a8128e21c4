import { copyFileSync, mkdirSync } from "node:fs";
import { homedir } from "node:os";
import { join } from "node:path";

import { inRoot, mustRun, say } from "../lib/run.js";
import { setUpWasmPack } from "../setup/rust.js";
import { unlessUnchanged } from "../lib/stamp.js";

interface Module {
  /** The folder of the crate. */
  crate: string;
  /** The folder in src/ts and in dist. */
  folder: string;
  /** What of wasm-pack's files is used, and its name there. */
  files: Record<string, string>;
  /** For cargo. */
  options?: string[];
  /** For rustc. */
  flags?: string;
}

/** hpr.js would start the wasm, so it is left out. Its types also fit hpr_bg.js. */
const GLUE = {
  "hpr_bg.js": "hpr_bg.js",
  "hpr.d.ts": "hpr_bg.d.ts",
  "hpr_bg.wasm": "hpr_bg.wasm",
  "hpr_bg.wasm.d.ts": "hpr_bg.wasm.d.ts",
};

const MODULES: Module[] = [
  { crate: "src/cdylib", folder: "lite", files: GLUE, options: ["--no-default-features"] },
  // Every browser since 2023 has numbers in four lanes.
  { crate: "src/cdylib", folder: "wasm", files: GLUE, flags: "-C target-feature=+simd128" },
  // Its functions take and return numbers, so it needs no glue.
  { crate: "src/files", folder: "formats", files: { "hpr_bg.wasm": "files.wasm" } },
];

/** The modules and their glue, in src/ts and in dist. */
export const WASM_FILES = MODULES.flatMap(({ folder, files }) =>
  Object.values(files).map((file) => `${folder}/${file}`),
);

/** Compiles Rust to WebAssembly. Puts each module and its glue into src/ts, beside the code that uses them. */
export async function buildWasm(): Promise<void> {
  const work = {
    name: "wasm",
    inputs: ["Cargo.toml", "Cargo.lock", "src", "scripts/build/wasm.ts", "package-lock.json"],
    ignore: ["src/ts"],
    outputs: WASM_FILES.map((file) => `src/ts/${file}`),
  };
  const result = await unlessUnchanged(work, async () => {
    await setUpWasmPack();
    say("Building the WebAssembly modules…");
    for (const module of MODULES) await buildModule(module);
  });
  say(`WebAssembly modules: ${result}`);
}

async function buildModule({ crate, folder, files, options = [], flags = "" }: Module): Promise<void> {
  const pkg = inRoot("target/pkg", folder);
  // With the glue for bundlers, the package starts the wasm itself, and starts another copy after a trap.
  const kind = ["--target", "bundler", "--release", "--no-pack", "--out-dir", pkg, "--out-name", "hpr"];
  // The wasm contains the paths of crates. The flag makes them, and so the bytes, equal everywhere.
  const crates = process.env["CARGO_HOME"] ?? join(homedir(), ".cargo");
  const env = { RUSTFLAGS: `${process.env["RUSTFLAGS"] ?? ""} ${flags} --remap-path-prefix=${crates}=cargo` };
  const args = ["--log-level", "error", "build", crate, ...kind, "--locked", ...options];
  await mustRun("wasm-pack", args, `The WebAssembly module of ${crate} could not be built`, { env });
  mkdirSync(inRoot("src/ts", folder), { recursive: true });
  for (const [built, file] of Object.entries(files)) copyFileSync(join(pkg, built), inRoot("src/ts", folder, file));
}
