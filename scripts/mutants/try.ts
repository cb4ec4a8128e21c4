import { existsSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { findOnPath, inRoot } from "../lib/paths.js";
import { Problem, mustRun, run } from "../lib/run.js";
import type { Result } from "./results.js";
import { fileOf } from "./results.js";
import { tree } from "./tree.js";

const out = inRoot("target", "mutation");

/** The limit of memory in bytes: a mutant that never ends must not take all memory of the machine. */
const MEMORY = 4e9;
/** The limit of time in seconds. It is only for tests that wait without using CPU. */
const LONGEST = 7200;

/** A set of tests: its name, and the result of a mutant if none of the tests fails. */
export interface Tests {
  title: string;
  missed: Result;
  /** The limit of CPU time for each test program, in seconds. */
  seconds: number;
  args: string[];
}

const FAIL_FAST = ["--", "-Zunstable-options", "--fail-fast"];

/** The tests that fit best to the files of a pattern. They take only seconds. */
export const quickTests: [pattern: RegExp, tests: Tests][] = [
  [
    /sector|share|division/,
    quick("those of sectors", ["--test", "core"], "fixtures:: sectors:: survivors:: --skip every_radius"),
  ],
  [/motion|repair/, quick("those of moved views", ["--test", "core"], "motion:: survivors:: --skip around_large")],
  [/predicates|exact_sum/, quick("unit tests of signs", ["--lib"], "predicates:: exact_sum::")],
  [
    /./,
    quick(
      "unit tests, small and thin clouds",
      ["--lib", "--test", "core"],
      "tests:: definition:: fixtures:: oracle:: survivors:: thin::",
    ),
  ],
];

export const allTests: Tests = {
  title: "all tests",
  missed: "missed",
  seconds: 1500,
  args: ["--lib", "--test", "core", ...FAIL_FAST],
};

function quick(title: string, programs: string[], filter: string): Tests {
  return { title, missed: "open", seconds: 30, args: [...programs, ...FAIL_FAST, ...filter.split(" ")] };
}

/** Refuses to start if the tests fail without a mutant. */
export async function checkTests({ seconds, args }: Tests): Promise<void> {
  const place = ["--manifest-path", join(tree, "Cargo.toml"), "--target-dir", join(tree, "target")];
  const all = ["--config", limit(seconds), "test", "--locked", "--profile", "mutants", ...place, ...args];
  await mustRun("cargo", all, "The tests fail without a mutant");
}

/**
 * Sets how cargo starts test programs. They end at the first failure. If this machine has `prlimit`, they also end at
 * the limits of CPU time and memory. Returns the configuration file for cargo.
 */
function limit(seconds: number): string {
  const limits = ["prlimit", `--as=${MEMORY}`, `--cpu=${seconds}:${seconds + 5}`];
  // Stable Rust allows `--fail-fast` if this variable is set.
  const runner = ["env", "RUSTC_BOOTSTRAP=1", ...(findOnPath("prlimit") === undefined ? [] : limits)];
  const file = join(tree, ".cargo", "config.toml");
  writeFileSync(file, `[target.'cfg(unix)']\nrunner = ${JSON.stringify(runner)}\n`);
  return file;
}

/** The names of the mutants of these files, or of all files if none is given: `file:line:column: what`. */
export async function listMutants(files: string[], shard: string | undefined): Promise<string[]> {
  const part = shard === undefined ? [] : ["--shard", shard, "--sharding", "round-robin"];
  const args = ["mutants", "--list", "--dir", tree, ...files.flatMap((glob) => ["--file", glob]), ...part];
  const { ok, output } = await run("cargo-mutants", args, { show: "nothing" });
  if (!ok) throw new Problem(`The mutants could not be listed:\n${output}`);
  return output.split("\n").filter((line) => /^src\/.+:\d+:\d+: /.test(line));
}

interface Outcome {
  scenario: "Baseline" | { Mutant: { name: string } };
  summary: string;
  log_path: string;
}

const SUMMARIES: Record<string, Result> = { CaughtMutant: "caught", Unviable: "unviable", Timeout: "timeout" };

/** Tries these mutants. If it is stopped, it returns the results of the mutants that were finished. */
export async function tryMutants(names: string[], tests: Tests): Promise<[string, Result][]> {
  limit(tests.seconds);
  rmSync(join(out, "mutants.out"), { recursive: true, force: true });
  rmSync(join(out, "mutants.out.old"), { recursive: true, force: true });
  // Version 27.1 lets mutants that delete a field pass every `--re`, so the files are named, too.
  const files = [...new Set(names.map(fileOf))].flatMap((file) => ["--file", file]);
  const which = names.flatMap((name) => ["--re", `^${name.replace(/[.*+?^${}()|[\]\\&~#-]/g, "\\$&")}$`]);
  const how = ["--in-place", "--dir", tree, "--output", out, "--baseline", "skip", "--timeout", String(LONGEST)];
  const { output } = await run("cargo-mutants", ["mutants", ...files, ...which, ...how, "--", ...tests.args], {
    show: "nothing",
  });
  const file = join(out, "mutants.out", "outcomes.json");
  if (!existsSync(file)) throw new Problem(`cargo-mutants did not start:\n${output}`);
  const { outcomes } = JSON.parse(readFileSync(file, "utf8")) as { outcomes: Outcome[] };
  return outcomes.flatMap(({ scenario, summary, log_path }) => {
    if (scenario === "Baseline" || !names.includes(scenario.Mutant.name)) return [];
    const isSlow = readFileSync(join(out, "mutants.out", log_path), "utf8").includes("SIGXCPU");
    return [[scenario.Mutant.name, isSlow ? "timeout" : (SUMMARIES[summary] ?? tests.missed)]];
  });
}
