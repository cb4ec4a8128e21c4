import { existsSync } from "node:fs";

import { findOnPath } from "../lib/paths.js";
import { Problem, mustRun, run, say, succeeds } from "../lib/run.js";

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
export async function setUpTarget(target: string): Promise<void> {
  const { output } = await run("rustc", ["--print", "target-libdir", "--target", target], { show: "nothing" });
  if (existsSync(output.trim())) return;
  needRustup(`the Rust target ${target}`);
  say(`Installing the Rust target ${target}…`);
  await mustRun("rustup", ["target", "add", target], `The Rust target ${target} could not be installed`);
}

/** Installs rustfmt and clippy if they are missing. */
export async function setUpComponents(): Promise<void> {
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
