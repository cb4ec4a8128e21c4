import { spawnSync } from "node:child_process";

import { environment, inRoot, root, TSC } from "./paths.js";
import { mustRun } from "./run.js";

/** Compiles a folder of tests and runs its main program, which gets the arguments of the command. */
export async function runCompiled(
  folder: "bench" | "fidelity" | "figures",
  env: Record<string, string>,
): Promise<void> {
  await mustRun(process.execPath, [TSC, "-p", `tests/${folder}`], `tests/${folder} does not compile`);
  const args = [inRoot("target", folder, "tests", folder, "main.js"), ...process.argv.slice(3)];
  const { status } = spawnSync(process.execPath, args, { cwd: root, env: environment(env), stdio: "inherit" });
  process.exitCode = status ?? 1;
}
