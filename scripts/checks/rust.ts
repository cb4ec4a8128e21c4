import { run } from "../lib/run.js";
import { BARE_TARGET } from "../setup/rust.js";
import { SETUP, WASM_PACK } from "./build.js";
import type { Check, Outcome } from "./check.js";
import { checkCommand, counted, sum } from "./check.js";
import { roomsCheck } from "./rooms.js";

const NATIVE = ["test", "--locked", "--profile", "fuzz", "--no-fail-fast"];
const DENY_WARNINGS = ["--", "-D", "warnings"];
const NO_STD = "--no-default-features";
const ON_BARE = ["--target", BARE_TARGET];

export const rustChecks: Check[] = [
  {
    title: "Rust: tests, native",
    part: "core",
    needs: [SETUP],
    locks: "fuzz",
    // The examples are left out: cargo would link each of them by itself, and clippy compiles them anyway.
    run: async () =>
      sum([await cargoTest("cargo", [...NATIVE, "--lib", "--tests"]), await cargoTest("cargo", [...NATIVE, "--doc"])]),
  },
  roomsCheck,
  {
    title: "Rust: tests in WebAssembly, under Node",
    part: "core",
    needs: [WASM_PACK],
    locks: "wasm",
    run: () => cargoTest("wasm-pack", ["test", "--node", ".", "--locked", "--profile", "quick", "--test", "core"]),
  },
  {
    title: "Rust: formatting",
    part: "format",
    needs: [SETUP],
    run: () => checkCommand("cargo", ["fmt", "--all", "--check"]),
  },
  {
    title: "Rust: lints, every feature, with and without std",
    part: "lint",
    needs: [SETUP],
    locks: "debug",
    run: async () => {
      const clippy = (...what: string[]) => checkCommand("cargo", ["clippy", "--locked", ...what, ...DENY_WARNINGS]);
      return sum([
        await clippy("--workspace", "--all-targets", "--all-features"),
        // A target without std, and a crate that depends on this one there.
        await clippy("--package", "hidden-point-removal", "--package", "dependent", "--lib", NO_STD, ...ON_BARE),
        // The small module, without --target: that would compile every macro again.
        await clippy("--lib", NO_STD, "--features", "lite"),
      ]);
    },
  },
  {
    title: "Rust: documentation",
    part: "docs",
    needs: [SETUP],
    locks: "debug",
    run: () =>
      checkCommand("cargo", ["doc", "--locked", "--no-deps", "--all-features"], { RUSTDOCFLAGS: "-D warnings" }),
  },
  {
    title: "Packaging: crate",
    part: "packaging",
    needs: [SETUP],
    locks: "debug",
    // Builds the crate from the files that would be uploaded.
    run: () => checkCommand("cargo", ["package", "--locked", "--allow-dirty"]),
  },
];

/** Runs tests and adds up the `test result:` lines of every test program. */
async function cargoTest(command: "cargo" | "wasm-pack", args: string[]): Promise<Outcome> {
  const { ok, output } = await run(command, args, { show: "results" });
  const lines = [...output.matchAll(/test result: .*?(\d+) passed; (\d+) failed/g)];
  const counts = sum(lines.map(([, passed, failed]) => ({ passed: Number(passed), failed: Number(failed) })));
  const failures = [...output.matchAll(/^test (.+) \.\.\. (?:FAILED|FAIL)$/gm)].map(([, test]) => test!);
  return counted(ok, { ...counts, failures });
}
