import { join } from "node:path";

import { findOnPath, toolsRoot } from "../lib/paths.js";
import { mustRun, say } from "../lib/run.js";

const CARGO_DENY = "0.20.2";

export function hasCargoDeny(): boolean {
  return findOnPath("cargo-deny") !== undefined;
}

/** Installs cargo-deny into target/tools: about two minutes of one core. */
export async function setUpCargoDeny(): Promise<void> {
  if (hasCargoDeny()) return;
  say(`Building cargo-deny ${CARGO_DENY} (about two minutes)…`);
  const folders = ["--root", toolsRoot, "--target-dir", join(toolsRoot, "deny")];
  const args = ["install", "cargo-deny", "--version", CARGO_DENY, "--locked", "--debug", ...folders];
  await mustRun("cargo", args, "cargo-deny could not be built", { env: { CARGO_PROFILE_DEV_DEBUG: "0" } });
}
