import { readFileSync } from "node:fs";

import { inRoot } from "../lib/paths.js";
import { mustRun, say } from "../lib/run.js";

const WASM_PACK = "0.15.1";

/**
 * Installs wasm-pack, and the commands of wasm-bindgen of the version in Cargo.lock, into target/tools. They run for
 * seconds, but to optimize them would take minutes.
 */
export async function setUpWasmPack(): Promise<void> {
  await install("wasm-pack", WASM_PACK, "--locked");
  // Its own lock file names versions that a mirror of crates.io may lack. Without features it needs no TLS.
  const [, locked] = /name = "wasm-bindgen"\nversion = "(.+)"/.exec(readFileSync(inRoot("Cargo.lock"), "utf8"))!;
  await install("wasm-bindgen-cli", locked!, "--no-default-features");
}

async function install(crate: string, version: string, ...options: string[]): Promise<void> {
  const folder = inRoot("target/tools");
  say(`Installing ${crate} ${version}, unless target/tools has it (about a minute)…`);
  const args = ["install", crate, "--version", version, ...options, "--debug", "--root", folder];
  const env = { CARGO_TARGET_DIR: `${folder}/build`, CARGO_PROFILE_DEV_DEBUG: "0" };
  await mustRun("cargo", ["--quiet", ...args], `${crate} could not be installed`, { env });
}
