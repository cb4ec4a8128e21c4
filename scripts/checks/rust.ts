import { run } from "../lib/run.js";
import { BARE_TARGET, WASM_TARGET } from "../setup/rust.js";
import { SETUP } from "./build.js";
import type { Check, Outcome } from "./check.js";
import { checkCommand, counted, sum } from "./check.js";
import { roomsCheck } from "./rooms.js";

const DENY_WARNINGS = ["--", "-D", "warnings"];
const NO_STD = "--no-default-features";
const ON_WASM = ["--target", WASM_TARGET];
const ON_BARE = ["--target", BARE_TARGET];

export const rustChecks: Check[] = [
  {
    title: "Rust: tests, native",
    part: "core",
    needs: [SETUP],
    locks: "fuzz",
    // The examples are left out: cargo would link each of them by itself, and clippy compiles them anyway.
    run: async () => sum([await cargoTest("--lib", "--tests"), await cargoTest("--doc")]),
  },
  roomsCheck,
  {
    title: "Rust: the same bits in WebAssembly, under Node",
    part: "core",
    needs: [SETUP],
    locks: "wasm",
    // One corpus of every kind of question. Its digest is the native one, so what `core` proves natively holds here.
    run: () =>
      checkCommand(
        "cargo",
        ["run", "--locked", "--profile", "quick", "--package", "hpr-tests", "--bin", "bits_corpus", ...ON_WASM],
        { CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUNNER: "node tests/bits/run.mjs" },
      ),
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
async function cargoTest(...what: string[]): Promise<Outcome> {
  const args = ["test", "--locked", "--profile", "fuzz", "--no-fail-fast", ...what];
  const { ok, output } = await run("cargo", args, { show: "results" });
  const lines = [...output.matchAll(/test result: .*?(\d+) passed; (\d+) failed/g)];
  const counts = sum(lines.map(([, passed, failed]) => ({ passed: Number(passed), failed: Number(failed) })));
  const failures = [...output.matchAll(/^test (.+) \.\.\. (?:FAILED|FAIL)$/gm)].map(([, test]) => test!);
  return counted(ok, { ...counts, failures });
}
