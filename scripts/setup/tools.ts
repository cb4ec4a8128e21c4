import { inRoot } from "../lib/paths.js";
import { mustRun } from "../lib/run.js";

const FAILED = "The program that makes the glue of the WebAssembly modules could not be built";
const PROGRAM = ["--quiet", "--locked", "--manifest-path", "tools/wasm/Cargo.toml", "--target-dir", "target/tools"];

/** Compiles tools/wasm. */
export async function setUpWasmTools(): Promise<void> {
  await mustRun("cargo", ["build", ...PROGRAM], FAILED);
}

/** Writes the glue of a module, and the module with it, into a folder. */
export async function makeGlue(module: string, folder: string, failed: string): Promise<void> {
  await mustRun(inRoot("target/tools/debug/hpr-wasm-tools"), [module, folder], failed);
}
