// npm run minimum: compiles and tests the crate with the oldest Rust that Cargo.toml allows
// (rust-version).
import { readFileSync } from "node:fs";

import { command } from "./lib/command.js";
import { inRoot } from "./lib/paths.js";
import { Problem, mustRun, run } from "./lib/run.js";
import { setUpLinker } from "./setup/linker.js";
import { BARE_TARGET } from "./setup/rust.js";

const NO_STD = ["build", "--locked", "--lib", "--no-default-features", "--target", BARE_TARGET];
const CHECKS: [what: string, args: string[]][] = [
  ["the crate", ["build", "--locked", "--lib"]],
  ["the crate without std", NO_STD],
  ["examples", ["build", "--locked", "--examples"]],
  ["fuzzers, benchmarks", ["build", "--locked", "--package", "hpr-tests", "--bins"]],
  ["tests", ["test", "--locked", "--profile", "quick", "--lib", "--test", "core"]],
];

await command(async () => {
  await setUpLinker();
  const version = oldest();
  const install = ["toolchain", "install", version, "--profile", "minimal", "--no-self-update"];
  await mustRun("rustup", [...install, "--target", BARE_TARGET], `Rust ${version} could not be installed`);
  const rows: string[] = [];
  for (const [what, args] of CHECKS) {
    const { ok, output } = await run("cargo", [`+${version}`, ...args], {
      show: "results",
      env: { CARGO_TARGET_DIR: inRoot("target", "minimum") },
    });
    if (!ok) process.exitCode = 1;
    const passed = [...output.matchAll(/test result: ok\. (\d+) passed/g)].reduce((sum, [, n]) => sum + Number(n), 0);
    rows.push(`${what}: ${ok ? (passed > 0 ? `${passed} passed` : "compiles") : "FAILED"}`);
  }
  const { output } = await run("cargo", [`+${version}`, "--version"], { show: "nothing" });
  console.log(`\n${output.trim()}\n${rows.join("\n")}`);
});

function oldest(): string {
  const [, version] = /^rust-version = "([^"]+)"/m.exec(readFileSync(inRoot("Cargo.toml"), "utf8")) ?? [];
  if (version === undefined) throw new Problem("Cargo.toml has no rust-version.");
  return version.split(".").length === 2 ? `${version}.0` : version;
}
