// npm run reproduce: builds the last commit twice from nothing, in different folders and with different
// homes of cargo, and compares every byte of the npm package. Writes tests/release/REPRODUCED.md.
import { mkdirSync, mkdtempSync, rmSync, symlinkSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

import { command } from "./lib/command.js";
import { environment, inRoot } from "./lib/paths.js";
import { Problem, mustRun, run, say } from "./lib/run.js";
import { digestOfAll, digestsIn } from "./release/digests.js";
import { setUpForBuild } from "./setup/setup.js";

const WASM = "wasm/hpr_bg.wasm";

await command(async () => {
  await setUpForBuild();
  const commit = await lastLine("git", "log", "-1", "--format=%h, %as");
  const folder = mkdtempSync(join(tmpdir(), "hpr-reproduce-"));
  try {
    const first = await built(join(folder, "first"), {});
    const second = await built(join(folder, "another", "place"), { CARGO_HOME: join(folder, "cargo") });
    const names = [...new Set([...first.keys(), ...second.keys()])];
    const different = names.filter((name) => first.get(name) !== second.get(name));
    if (different.length > 0) throw new Problem(`The two builds differ in: ${different.join(", ")}`);
    console.log(`The two builds are equal:\n${await report(commit, first)}`);
  } finally {
    rmSync(folder, { recursive: true });
  }
});

/** Builds the last commit in a folder of its own. Returns the digests of the npm package's files. */
async function built(folder: string, env: Record<string, string>): Promise<Map<string, string>> {
  say(`Building in ${folder}…`);
  await mustRun("git", ["clone", "--quiet", inRoot("."), folder], "The repository could not be copied");
  mkdirSync(join(folder, "target"));
  // Neither of these is built from the sources of this repository.
  symlinkSync(inRoot("node_modules"), join(folder, "node_modules"), "dir");
  symlinkSync(inRoot("target", "tools"), join(folder, "target", "tools"), "dir");
  const args = [join(folder, "scripts", "bootstrap.mjs"), "build", "package"];
  // The PATH of this process belongs to this repository. The build makes its own PATH.
  const { PATH = "" } = environment();
  await mustRun(process.execPath, args, "The build failed", { env: { ...env, PATH } });
  return digestsIn(join(folder, "dist"));
}

async function lastLine(program: string, ...args: string[]): Promise<string> {
  return (await run(program, args, { show: "nothing" })).output.trim().split("\n").at(-1)!;
}

async function report(commit: string, digests: Map<string, string>): Promise<string> {
  return [
    `commit ${commit}`,
    await lastLine("rustc", "--version"),
    await lastLine("wasm-opt", "--version"),
    `TypeScript ${await lastLine("tsc", "--version")}`,
    `${digests.size} files; sha256 of dist/${WASM}: ${digests.get(WASM) ?? ""}`,
    `sha256 of all names and digests: ${digestOfAll(digests)}`,
  ].join("\n");
}
