import { run } from "../lib/run.js";
import { BARE_TARGET, WASM_TARGET } from "../setup/rust.js";
import { SETUP, TOOLS } from "./build.js";
import type { Check, Outcome } from "./check.js";
import { checkCommand, counted, sum } from "./check.js";
import { roomsCheck } from "./rooms.js";

const DENY_WARNINGS = ["--", "-D", "warnings"];
const NO_STD = "--no-default-features";

/** The builds of tests/consumers/crate. The bare target has no std. */
const KINDS_OF_USERS = [
  [],
  [NO_STD],
  ["--target", WASM_TARGET],
  ["--target", WASM_TARGET, NO_STD],
  ["--target", BARE_TARGET, NO_STD],
];

export const rustChecks: Check[] = [
  {
    title: "Rust: tests, native",
    part: "core",
    needs: [SETUP],
    locks: "fuzz",
    // The examples are left out: cargo would link each of them by itself, and clippy compiles them anyway.
    run: async () => sum([await cargoTest("fuzz", ["--lib", "--tests"]), await cargoTest("fuzz", ["--doc"])]),
  },
  roomsCheck,
  {
    title: "Rust: tests in WebAssembly, under Node",
    part: "core",
    needs: [TOOLS],
    locks: "wasm",
    // One corpus of every kind of question. Its digest is the native one, so what `core` proves natively holds here.
    run: () =>
      cargoTest("quick", ["--test", "same_bits", "--target", WASM_TARGET], {
        CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUNNER: "wasm-bindgen-test-runner",
        WASM_BINDGEN_TEST_TIMEOUT: "300",
      }),
  },
  {
    title: "Rust: a crate that depends on this one",
    part: "core",
    needs: [SETUP],
    locks: "debug",
    run: async () => {
      const outcomes: Outcome[] = [];
      for (const args of KINDS_OF_USERS) {
        outcomes.push(await checkCommand("cargo", ["build", "--locked", "--package", "dependent", ...args]));
      }
      return sum(outcomes);
    },
  },
  {
    title: "Rust: formatting",
    part: "format",
    needs: [SETUP],
    run: () => checkCommand("cargo", ["fmt", "--all", "--check"]),
  },
  {
    title: "Rust: lints, every target and feature",
    part: "lint",
    needs: [SETUP],
    locks: "debug",
    run: () =>
      checkCommand("cargo", ["clippy", "--locked", "--workspace", "--all-targets", "--all-features", ...DENY_WARNINGS]),
  },
  {
    title: "Rust: lints, without features",
    part: "lint",
    needs: [SETUP],
    locks: "debug",
    run: () => checkCommand("cargo", ["clippy", "--locked", "--lib", NO_STD, ...DENY_WARNINGS]),
  },
  {
    title: "Rust: lints, WebAssembly",
    part: "lint",
    needs: [SETUP],
    locks: "debug",
    run: async () => {
      const clippy = (...what: string[]) =>
        checkCommand("cargo", ["clippy", "--locked", "--lib", ...what, "--target", WASM_TARGET, ...DENY_WARNINGS]);
      return sum([
        await clippy("--test", "same_bits", "--features", "wasm"),
        await clippy(NO_STD, "--features", "lite"),
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

/** Runs tests in a profile of Cargo.toml and adds up the `test result:` lines of every test program. */
async function cargoTest(
  profile: "quick" | "fuzz",
  what: string[],
  env: Record<string, string> = {},
): Promise<Outcome> {
  const args = ["test", "--locked", "--profile", profile, "--no-fail-fast", ...what];
  const { ok, output } = await run("cargo", args, { show: "results", env });
  const lines = [...output.matchAll(/test result: .*?(\d+) passed; (\d+) failed/g)];
  const counts = sum(lines.map(([, passed, failed]) => ({ passed: Number(passed), failed: Number(failed) })));
  const failures = [...output.matchAll(/^test (.+) \.\.\. (?:FAILED|FAIL)$/gm)].map(([, test]) => test!);
  return counted(ok, { ...counts, failures });
}
