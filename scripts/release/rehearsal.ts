import { mustRun } from "../lib/run.js";

/** Rehearses both publications, without sending anything. */
export async function rehearse(): Promise<void> {
  await mustRun("cargo", ["publish", "--dry-run", "--locked"], "The crate could not be published");
  const npm = ["publish", "--dry-run", "--provenance", "--access", "public"];
  await mustRun("npm", npm, "The package could not be published");
}
