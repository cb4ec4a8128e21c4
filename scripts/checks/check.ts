import { mkdirSync, readFileSync, rmSync } from "node:fs";
import { relative } from "node:path";
import { stripVTControlCharacters } from "node:util";

import type { Job } from "../lib/schedule.js";
import { Problem, inRoot, root, run } from "../lib/run.js";
import { build } from "../build/build.js";
import { setUpForChecks, setUpWasmPack } from "../setup/rust.js";

/** The parts of `npm test`. Each can be run alone; `npm test -- core page` runs two. */
const PARTS = {
  core: "the Rust crate: native tests, tests in WebAssembly, no_std",
  package: "the npm package under Node",
  page: "the demo page and the adapters that draw, in Chromium",
  python: "the Python package",
  types: "the TypeScript of package, page, tests and scripts",
  lint: "clippy and oxlint",
  format: "rustfmt and oxfmt",
  docs: "rustdoc and typedoc",
  packaging: "the crate and the npm package as they would be published, and users' projects",
  supply: "licenses and sources of everything that is built in",
  scripts: "the commands themselves",
} as const;

type Part = keyof typeof PARTS;

/** The parts that the arguments name, or all parts if there are no arguments. */
export function chosenParts(names: string[]): Set<Part> {
  const all = Object.keys(PARTS) as Part[];
  const unknown = names.find((name) => !Object.hasOwn(PARTS, name));
  if (unknown !== undefined) {
    const list = all.map((part) => `  ${part.padEnd(10)} ${PARTS[part]}`);
    throw new Problem(`npm test has no part "${unknown}". Its parts are:\n${list.join("\n")}`);
  }
  return new Set(names.length === 0 ? all : (names as Part[]));
}

/** How many tests a check ran. A check that is a single yes or no counts as one. */
export interface Outcome {
  passed: number;
  failed: number;
  /** The names of failed tests, each with the first line of its message, if the check knows them. */
  failures?: string[];
  /** The reason why the check ran nothing: this machine or this repository lacks something. */
  skipped?: string;
}

/** One heading of `npm test`. */
export interface Check extends Job {
  /** A check without a part runs only if a chosen check needs it. */
  part: Part | undefined;
  /** The folder of target/ that cargo locks. Two cargo commands with the same folder would wait for each other. */
  locks?: "debug" | "fuzz";
  run: () => Promise<Outcome>;
}

export const PASS: Outcome = { passed: 1, failed: 0 };
export const FAIL: Outcome = { passed: 0, failed: 1 };

/** Runs a command that counts as one check. */
export async function checkCommand(name: string, args: string[], env: Record<string, string> = {}): Promise<Outcome> {
  return (await run(name, args, { show: "results", env })).ok ? PASS : FAIL;
}

/** Adds several outcomes. */
export function sum(outcomes: Outcome[]): Required<Omit<Outcome, "skipped">> {
  return {
    passed: outcomes.reduce((total, one) => total + one.passed, 0),
    failed: outcomes.reduce((total, one) => total + one.failed, 0),
    failures: outcomes.flatMap(({ failures = [] }) => failures),
  };
}

/**
 * The tests that a command counted. A command that failed is never a success (it may have
 * crashed between two tests), nor is a command that ran no test.
 */
export function counted(ok: boolean, counts: Outcome): Outcome {
  const wrong = !ok || counts.passed === 0;
  return { ...counts, failed: Math.max(counts.failed, wrong ? 1 : 0) };
}

interface Options {
  env?: Record<string, string>;
  /** How many files run at once. By default vitest keeps one core for itself. */
  atOnce?: number;
}

/** Runs the tests of one directory and reads the counts from vitest's report. */
export async function vitest(directory: string, { env = {}, atOnce }: Options = {}): Promise<Outcome> {
  const report = inRoot("target", "reports", `${directory.replace("/", "-")}.json`);
  mkdirSync(inRoot("target", "reports"), { recursive: true });
  rmSync(report, { force: true });
  const reporters = ["--reporter=default", "--reporter=json", `--outputFile.json=${report}`];
  const workers = atOnce === undefined ? [] : [`--maxWorkers=${atOnce}`];
  const { ok } = await run("vitest", ["run", `${directory}/`, ...reporters, ...workers], { show: "results", env });
  return counted(ok, countsIn(report));
}

interface Report {
  numPassedTests: number;
  numFailedTests: number;
  testResults: { name: string; message: string; assertionResults: Assertion[] }[];
}

interface Assertion {
  fullName: string;
  status: string;
  failureMessages: string[];
}

function countsIn(file: string): Outcome {
  try {
    const report = JSON.parse(readFileSync(file, "utf8")) as Report;
    return { passed: report.numPassedTests, failed: report.numFailedTests, failures: failuresIn(report) };
  } catch {
    // vitest ended without a report.
    return { passed: 0, failed: 0 };
  }
}

function failuresIn({ testResults }: Report): string[] {
  return testResults.flatMap(({ name, message, assertionResults }) => {
    const file = relative(root, name);
    const failed = assertionResults.filter(({ status }) => status === "failed");
    const lines = failed.map(({ fullName, failureMessages: [why = ""] }) => `${file} > ${fullName}: ${firstLine(why)}`);
    return message === "" ? lines : [...lines, `${file}: ${firstLine(message)}`];
  });
}

function firstLine(message: string): string {
  return stripVTControlCharacters(message).split("\n", 1)[0]!;
}

export const SETUP = "Set-up: Rust";
export const WASM_PACK = "Set-up: wasm-pack";
export const BUILD = "Build: WebAssembly, npm package, demo page";

/** Checks that belong to no part. Other checks need them. */
export const groundwork: Check[] = [
  step(SETUP, setUpForChecks),
  step(WASM_PACK, setUpWasmPack, { needs: [SETUP] }),
  step(BUILD, build, { needs: [WASM_PACK] }),
];

function step(title: string, work: () => Promise<void>, more: Partial<Check> = {}): Check {
  const run = async () => {
    await work();
    return PASS;
  };
  return { title, part: undefined, run, ...more };
}
