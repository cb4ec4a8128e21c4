import { readFileSync, rmSync } from "node:fs";
import { join } from "node:path";

import { inRoot, toolsRoot } from "../lib/paths.js";
import { Problem, mustRun, run, say } from "../lib/run.js";

const WASM_PACK = "0.15.1";

// The tools run for seconds, but optimizing them would take minutes.
const QUICK_BUILD = ["--debug", "--locked", "--root", toolsRoot, "--target-dir", join(toolsRoot, "build")];
const NO_DEBUG_INFO = { CARGO_PROFILE_DEV_DEBUG: "0" };

/** Installs wasm-pack, and the wasm-bindgen commands of the version in Cargo.lock. */
export async function setUpWasmTools(): Promise<void> {
  const version = lockedVersion("Cargo.lock");
  if ((await hasWasmPack()) && (await hasWasmBindgen(version))) return;
  if (lockedVersion("tools/wasm/Cargo.lock") !== version) {
    throw new Problem(
      `Cargo.lock has wasm-bindgen ${version}, but tools/wasm builds another version: ` +
        "set it in the Cargo.toml there, and run `cargo update` there.",
    );
  }
  say(`Building wasm-bindgen ${version} and wasm-pack (about two minutes)…`);
  const args = ["install", "--path", inRoot("tools", "wasm"), "--force", ...QUICK_BUILD];
  await mustRun("cargo", args, "wasm-bindgen and wasm-pack could not be built", { env: NO_DEBUG_INFO });
  // This folder has 800 MB that only a new version would use again.
  rmSync(join(toolsRoot, "build"), { recursive: true, force: true });
}

/** Both commands must have exactly the version in Cargo.lock. */
async function hasWasmBindgen(version: string): Promise<boolean> {
  const found = [await versionOf("wasm-bindgen"), await versionOf("wasm-bindgen-test-runner")];
  return found.every((one) => one === version);
}

/** Any wasm-pack is good enough that is not older than the version with which this build was written. */
async function hasWasmPack(): Promise<boolean> {
  const found = await versionOf("wasm-pack");
  return found !== undefined && found.localeCompare(WASM_PACK, "en", { numeric: true }) >= 0;
}

async function versionOf(command: string): Promise<string | undefined> {
  const { output } = await run(command, ["--version"], { show: "nothing" });
  return /^[\w-]+ (\d+\.\d+\.\d+)/m.exec(output)?.[1];
}

function lockedVersion(lockFile: string): string {
  const [, version] = /name = "wasm-bindgen"\nversion = "([^"]+)"/.exec(readFileSync(inRoot(lockFile), "utf8")) ?? [];
  if (version === undefined) throw new Problem(`${lockFile} has no wasm-bindgen.`);
  return version;
}
