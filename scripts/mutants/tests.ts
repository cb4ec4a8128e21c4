import { createHash } from "node:crypto";
import { existsSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { findOnPath } from "../lib/paths.js";
import { Problem, run, say } from "../lib/run.js";
import { out } from "./tree.js";

/** The limit of memory in bytes: a mutant that never ends must not take all memory of the machine. */
const MEMORY = 4e9;

export interface Test {
  program: string;
  name: string;
  /** How many seconds of CPU it takes. */
  seconds: number;
  /** Numbers of the mutants that it reaches. */
  reached: Set<number>;
}

/** What is known about the tests of a program, by its digest: measuring takes minutes. */
const KNOWN = join(out, "tests.json");

/** Tests that take more seconds of CPU are no quick tests. */
const QUICK = 2;

/** Which tests are run. */
export interface Choice {
  /** Whether tests that are not quick are left out. */
  quick: boolean;
  /** The beginnings of the names of tests. If there are any, these tests are run, whatever they take, and no others. */
  names: string[];
}

/** Runs each test alone, without an active mutant. Finds out how long it takes and which mutants it reaches. */
export async function measureTests(programs: string[], { quick, names }: Choice): Promise<Test[]> {
  const digest = createHash("sha256");
  for (const program of programs) digest.update(readFileSync(program));
  const known = [quick, ...names, digest.digest("hex")].join(" ");
  const isChosen = (name: string): boolean => names.length === 0 || names.some((start) => name.startsWith(start));
  const longest = quick && names.length === 0 ? QUICK : 3600;
  const tests = remembered(known);
  if (tests.length > 0) return tests;
  for (const program of programs) {
    const { output } = await run(program, ["--list", "--format", "terse"], { show: "nothing" });
    for (const [, name] of output.matchAll(/^(.+): test$/gm))
      if (isChosen(name!)) tests.push(...(await measure(program, name!, longest)));
  }
  const seconds = tests.reduce((sum, test) => sum + test.seconds, 0);
  say(`${tests.length} tests, ${seconds.toFixed(0)} seconds`);
  const saved = tests.map((test) => ({ ...test, reached: [...test.reached] }));
  writeFileSync(KNOWN, JSON.stringify({ known, tests: saved }));
  return tests;
}

function remembered(known: string): Test[] {
  if (!existsSync(KNOWN)) return [];
  const saved = JSON.parse(readFileSync(KNOWN, "utf8")) as {
    known: string;
    tests: (Omit<Test, "reached"> & { reached: number[] })[];
  };
  return saved.known === known ? saved.tests.map((test) => ({ ...test, reached: new Set(test.reached) })) : [];
}

async function measure(program: string, name: string, longest: number): Promise<Test[]> {
  const file = join(out, "reached.txt");
  rmSync(file, { force: true });
  const { end, took: seconds } = await runTests(program, [name], longest, { MUTANT: "record", REACHED: file });
  if (end === "timeout") return [];
  if (end !== "passed") throw new Problem(`The test ${name} fails without a mutant.`);
  const reached = existsSync(file) ? readFileSync(file, "utf8").trim().split("\n").map(Number) : [];
  return [{ program, name, seconds, reached: new Set(reached) }];
}

interface Run {
  end: "passed" | "failed" | "timeout";
  /** The test that failed, if the program could say so. */
  failed?: string | undefined;
  /** How many seconds of CPU it took; where bash is missing, how long it took. */
  took: number;
}

/**
 * Runs tests of a program. They end at the first failure. If this machine has `prlimit`, they also end at the limit of
 * CPU time, and at the limit of memory.
 */
export async function runTests(
  program: string,
  names: string[],
  seconds: number,
  env: Record<string, string>,
): Promise<Run> {
  const args = ["--exact", ...names, "--test-threads=1", "-Zunstable-options", "--fail-fast"];
  const limits = ["prlimit", `--as=${MEMORY}`, "--core=0", `--cpu=${Math.ceil(seconds)}`];
  const timed = ["bash", "-c", 'TIMEFORMAT="cpu %U %S"; time "$@"', "bash"];
  const [command, ...rest] = [
    ...(findOnPath("bash") === undefined ? [] : timed),
    ...(findOnPath("prlimit") === undefined ? [] : limits),
    program,
    ...args,
  ];
  const start = performance.now();
  // Stable Rust allows `--fail-fast` if this variable is set.
  const { ok, output } = await run(command!, rest, { show: "nothing", env: { RUSTC_BOOTSTRAP: "1", ...env } });
  const [, user, system] = /^cpu ([\d.]+) ([\d.]+)$/m.exec(output) ?? [];
  const took = user === undefined ? (performance.now() - start) / 1000 : Number(user) + Number(system);
  if (ok) return { end: "passed", took };
  const [, failed] = /^test (\S+) \.\.\. FAILED/m.exec(output) ?? [];
  // A test program that ends at the limit of time prints no summary and no reason.
  const end = /^test result: FAILED|panicked at|memory allocation of|overflow/m.test(output) ? "failed" : "timeout";
  return { end, failed, took };
}
