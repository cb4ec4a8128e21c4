import { run } from "../lib/run.js";
import { BARE_TARGET, WASM_TARGET } from "../setup/rust.js";
import type { Check, Outcome } from "./check.js";
import { checkCommand, counted, sum } from "./check.js";
import { roomsCheck } from "./rooms.js";

const DENY_WARNINGS = ["--", "-D", "warnings"];

export const rustChecks: Check[] = [
  {
    title: "Rust: formatting",
    run: () => checkCommand("cargo", ["fmt", "--check"]),
  },
  roomsCheck,
  {
    title: "Rust: lints, every target and feature",
    run: () => checkCommand("cargo", ["clippy", "--locked", "--all-targets", "--all-features", ...DENY_WARNINGS]),
  },
  {
    title: "Rust: lints, WebAssembly",
    run: () => {
      const what = ["--lib", "--tests", "--features", "wasm", "--target", WASM_TARGET];
      return checkCommand("cargo", ["clippy", "--locked", ...what, ...DENY_WARNINGS]);
    },
  },
  {
    title: "Rust: no_std",
    run: () => {
      // Without std there is no allocator to link a cdylib with: the rlib alone.
      const rlib = ["rustc", "--locked", "--lib", "--crate-type", "rlib", "--no-default-features"];
      return checkCommand("cargo", [...rlib, "--target", BARE_TARGET]);
    },
  },
  {
    title: "Rust: tests, native",
    // Without the examples, each of which would be optimized as a whole; clippy has compiled them.
    run: async () => {
      const test = (what: string[]) => cargoTest("cargo", ["test", "--locked", "--release", "--no-fail-fast", ...what]);
      return sum([await test(["--lib", "--tests"]), await test(["--doc"])]);
    },
  },
  {
    title: "Rust: tests in WebAssembly, under Node",
    run: () => {
      // `--test core` keeps to the tests that are written for both; `.` stands
      // for the crate, which wasm-pack wants first.
      const args = ["test", "--node", "--release", "--mode", "no-install", ".", "--locked", "--test", "core"];
      return cargoTest("wasm-pack", args, { WASM_BINDGEN_TEST_TIMEOUT: "300" });
    },
  },
  {
    title: "Rust: documentation",
    run: () =>
      checkCommand("cargo", ["doc", "--locked", "--no-deps", "--all-features"], { RUSTDOCFLAGS: "-D warnings" }),
  },
  {
    title: "Packaging: crate",
    // Builds the crate from what would be uploaded.
    run: () => checkCommand("cargo", ["package", "--locked", "--allow-dirty"]),
  },
];

/** Adds up the `test result:` lines of every test program that ran. */
async function cargoTest(name: string, args: string[], env: Record<string, string> = {}): Promise<Outcome> {
  const { ok, output } = await run(name, args, { show: "results", env });
  const lines = [...output.matchAll(/test result: .*?(\d+) passed; (\d+) failed/g)];
  const counts = sum(lines.map(([, passed, failed]) => ({ passed: Number(passed), failed: Number(failed) })));
  const failures = [...output.matchAll(/^test (.+) \.\.\. (?:FAILED|FAIL)$/gm)].map(([, test]) => test!);
  return counted(ok, { ...counts, failures });
}
