import { BARE_TARGET } from "../setup/rust.js";
import {
  BUILD,
  PASS,
  SETUP,
  WASM_PACK,
  checkCommand,
  counted,
  sum,
  vitest,
  type Check,
  type Outcome,
} from "./check.js";
import { TSC, run } from "../lib/run.js";
import { python, setUpPython } from "../setup/python.js";
import { roomsCheck } from "./rooms.js";
import { setUpBrowser } from "../setup/system.js";

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
    // It runs beside the build, which has one core for most of its time.
    needs: [WASM_PACK],
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

const PYTHON = "Set-up: Python";

export const pythonChecks: Check[] = [
  { title: PYTHON, part: "python", needs: [SETUP], run: () => withPython(() => PASS) },
  {
    title: "Python package",
    part: "python",
    // The answers are compared with those of the npm package.
    needs: [PYTHON, BUILD],
    run: () => withPython(() => pytest("python/tests")),
  },
];

async function withPython(work: () => Promise<Outcome> | Outcome): Promise<Outcome> {
  // The tests of Dask, LAZ and Parquet skip themselves without their packages. `npm run test:scale` installs these.
  const lacking = await setUpPython(["matplotlib>=3.8", "mypy>=1.11", "pandas>=2", "scipy>=1.11"]);
  return lacking === undefined ? work() : { passed: 0, failed: 0, skipped: lacking };
}

/** Runs Python tests and reads the counts from the last line. `left` is how many tests skipped themselves. */
export async function pytest(...args: string[]): Promise<Outcome & { left: number }> {
  const { ok, output } = await run(python, ["-m", "pytest", "-q", "-p", "no:cacheprovider", ...args], {
    show: "results",
  });
  const count = (word: string): number => Number(new RegExp(`(\\d+) ${word}`).exec(output)?.[1] ?? 0);
  const counts = { passed: count("passed"), failed: count("failed") + count("errors?") };
  return { ...counted(ok, counts), left: count("skipped") };
}

export const typescriptChecks: Check[] = [
  {
    title: "TypeScript: types",
    part: "types",
    needs: [BUILD],
    run: async () => {
      const outcomes: Outcome[] = [];
      // The scripts are compiled by their own rules before they run. So are the last three, whose imports need endings.
      for (const project of [".", "tests/bench", "tests/fidelity", "tests/figures"]) {
        outcomes.push(await checkCommand(process.execPath, [TSC, "-p", project, "--noEmit"]));
      }
      return sum(outcomes);
    },
  },
  {
    title: "TypeScript: lints",
    part: "lint",
    needs: [BUILD],
    run: () => checkCommand("oxlint", []),
  },
  {
    title: "TypeScript: imports go downward",
    // Needs the build, because the check also follows imports of the generated glue and of the built package.
    part: "lint",
    needs: [BUILD],
    run: () => checkCommand("depcruise", ["--config", ".dependency-cruiser.mjs", "src/ts", "www", "scripts", "tests"]),
  },
  {
    title: "TypeScript, CSS, HTML: formatting",
    part: "format",
    run: () => checkCommand("oxfmt", ["--check"]),
  },
  {
    title: "TypeScript: documentation",
    part: "docs",
    needs: [BUILD],
    // Every public name must be explained, and every link must have a target.
    run: () => checkCommand("typedoc", ["--logLevel", "Warn"]),
  },
  {
    title: "Commands",
    part: "scripts",
    run: () => vitest("tests/scripts"),
  },
];

export const packageCheck: Check = {
  title: "npm package, under Node",
  part: "package",
  needs: [BUILD],
  // Some of its tests run examples of the crate.
  locks: "fuzz",
  run: () => vitest("tests/package", { atOnce: 2 }),
};

export const pageCheck: Check = {
  title: "Demo page, in Chromium",
  part: "page",
  needs: [BUILD],
  // Each test file spends half of its time waiting for its browser.
  run: async () => vitest("tests/browser", { env: { HPR_CHROMIUM: await setUpBrowser() }, atOnce: 2 }),
};
