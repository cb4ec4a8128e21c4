import { existsSync, readFileSync } from "node:fs";

import { Problem, findOnPath, inRoot, mustRun, run, say, succeeds } from "../lib/run.js";
import { setUpLinker } from "./system.js";

/** The oldest rustc whose LLVM knows all options of scripts/build/wasm.ts. */
const OLDEST = { major: 1, minor: 95 };

/** The target of wasm-bindgen, for the browser and Node. */
export const WASM_TARGET = "wasm32-unknown-unknown";
/** A target without an operating system. Building for it proves `no_std`. */
export const BARE_TARGET = "thumbv7em-none-eabihf";

/** Makes sure that there is a Rust toolchain that is new enough. */
export async function setUpRust(): Promise<void> {
  const rustup = findOnPath("rustup") !== undefined;
  if (!(await succeeds("rustc", "--version"))) {
    if (!rustup) throw new Problem("Rust is needed: install rustup from https://rustup.rs and run this again.");
    say("Installing the stable Rust toolchain…");
    const args = ["toolchain", "install", "stable", "--profile", "minimal", "--no-self-update"];
    await mustRun("rustup", args, "Rust could not be installed");
  }
  await checkVersion(rustup);
}

/** Installs the standard library of a target that rustc lacks. */
async function setUpTarget(target: string): Promise<void> {
  const { output } = await run("rustc", ["--print", "target-libdir", "--target", target], { show: "nothing" });
  if (existsSync(output.trim())) return;
  needRustup(`the Rust target ${target}`);
  say(`Installing the Rust target ${target}…`);
  await mustRun("rustup", ["target", "add", target], `The Rust target ${target} could not be installed`);
}

/** Installs rustfmt and clippy if they are missing. */
async function setUpComponents(): Promise<void> {
  for (const component of ["rustfmt", "clippy"]) {
    if (await succeeds(component === "rustfmt" ? "rustfmt" : "clippy-driver", "--version")) continue;
    needRustup(component);
    say(`Installing ${component}…`);
    await mustRun("rustup", ["component", "add", component], `${component} could not be installed`);
  }
}

async function checkVersion(rustup: boolean): Promise<void> {
  const { output } = await run("rustc", ["--version"], { show: "nothing" });
  const [, major, minor] = /^rustc (\d+)\.(\d+)/.exec(output) ?? [];
  if (Number(major) > OLDEST.major || Number(minor) >= OLDEST.minor) return;
  const wayOut = rustup ? "run `rustup update`" : "install it through https://rustup.rs";
  throw new Problem(`Rust ${OLDEST.major}.${OLDEST.minor} or newer is needed; this is ${output.trim()}: ${wayOut}.`);
}

function needRustup(what: string): void {
  if (findOnPath("rustup") !== undefined) return;
  throw new Problem(`${what} is missing, and there is no rustup to install it with: see https://rustup.rs`);
}

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

/** Installs everything that a build needs and that is missing. */
export async function setUpForBuild(): Promise<void> {
  await setUpRust();
  await setUpLinker();
  await setUpTarget(WASM_TARGET);
}

/** Installs what the Rust checks need besides that. (The page's tests set up the browser.) */
export async function setUpForChecks(): Promise<void> {
  await setUpForBuild();
  await setUpTarget(BARE_TARGET);
  await setUpComponents();
}
