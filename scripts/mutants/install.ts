import { join } from "node:path";

import { findOnPath, toolsRoot } from "../lib/paths.js";
import { mustRun, say } from "../lib/run.js";

const CARGO_MUTANTS = "27.1.0";

/** Installs cargo-mutants into target/tools: about two minutes of one core. */
export async function setUpCargoMutants(): Promise<void> {
  if (findOnPath("cargo-mutants") !== undefined) return;
  say(`Building cargo-mutants ${CARGO_MUTANTS} (about two minutes)…`);
  const folders = ["--root", toolsRoot, "--target-dir", join(toolsRoot, "mutants")];
  const args = ["install", "cargo-mutants", "--version", CARGO_MUTANTS, "--locked", "--debug", ...folders];
  await mustRun("cargo", args, "cargo-mutants could not be built", { env: { CARGO_PROFILE_DEV_DEBUG: "0" } });
}
