import { readFileSync, rmSync } from "node:fs";
import { join } from "node:path";

import { inRoot, toolsRoot } from "../lib/paths.js";
import { Problem, mustRun, run, say } from "../lib/run.js";

const WASM_PACK = "0.15.1";

// The tools run for seconds but take minutes to optimize.
const QUICK_BUILD = ["--debug", "--locked", "--root", toolsRoot, "--target-dir", join(toolsRoot, "build")];
const NO_DEBUG_INFO = { CARGO_PROFILE_DEV_DEBUG: "0" };

/** wasm-pack, and the wasm-bindgen commands of the version the crate is locked to. */
export async function setUpWasmTools(): Promise<void> {
  await setUpWasmBindgen();
  await setUpWasmPack();
  // 800 MB that only a new version would look at again.
  rmSync(join(toolsRoot, "build"), { recursive: true, force: true });
}

/** Both commands have to be of exactly the version the crate is locked to. */
async function setUpWasmBindgen(): Promise<void> {
  const version = lockedVersion("Cargo.lock");
  const found = [await versionOf("wasm-bindgen"), await versionOf("wasm-bindgen-test-runner")];
  if (found.every((one) => one === version)) return;
  if (lockedVersion("tools/wasm-bindgen/Cargo.lock") !== version) {
    throw new Problem(
      `Cargo.lock has wasm-bindgen ${version}, but tools/wasm-bindgen builds another version: ` +
        "set it in the Cargo.toml there, and run `cargo update` there.",
    );
  }
  say(`Building wasm-bindgen ${version} (about a minute)…`);
  const args = ["install", "--path", inRoot("tools", "wasm-bindgen"), "--force", ...QUICK_BUILD];
  await mustRun("cargo", args, "wasm-bindgen could not be built", { env: NO_DEBUG_INFO });
}

/** Any wasm-pack will do that is not older than the one the build was made with. */
async function setUpWasmPack(): Promise<void> {
  const found = await versionOf("wasm-pack");
  if (found !== undefined && found.localeCompare(WASM_PACK, "en", { numeric: true }) >= 0) return;
  say(`Installing wasm-pack ${WASM_PACK} (about a minute)…`);
  const args = ["install", `wasm-pack@${WASM_PACK}`, ...QUICK_BUILD];
  await mustRun("cargo", args, "wasm-pack could not be installed", { env: NO_DEBUG_INFO });
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
