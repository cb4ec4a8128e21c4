import { existsSync, readFileSync } from "node:fs";

import { inRoot } from "../lib/paths.js";

/**
 * A program that takes `--minutes M --seed N`. For each wrong answer it prints the facts that one needs to repeat it.
 * Its last line is `N tried, M wrong`.
 */
export interface Fuzzer {
  title: string;
  /** The Rust program, if the fuzzer is one. */
  program?: string;
  command: string[];
}

/** Functions of TypeScript files, `(minutes, seed) => Promise<{ tried, wrong } | wrong>`, by title. */
const FUNCTIONS: Record<string, { file: string; name: string }> = {
  files: { file: "tests/fuzz/files.ts", name: "fuzzFiles" },
  foreign: { file: "tests/fuzz/foreign.ts", name: "fuzzForeign" },
  qhull: { file: "tests/fuzz/qhull.ts", name: "fuzzQhull" },
  border: { file: "tests/fuzz/border.ts", name: "fuzzBorder" },
  stream: { file: "tests/fuzz/stream.ts", name: "fuzzStream" },
  workers: { file: "tests/fuzz/workers.ts", name: "fuzzWorkers" },
};

/** Every Rust program `fuzz_…` of tests/Cargo.toml, and the functions whose file exists. */
export function allFuzzers(): Fuzzer[] {
  const programs = [...readFileSync(inRoot("tests/Cargo.toml"), "utf8").matchAll(/^name = "fuzz_(\w+)"$/gm)];
  const inRust = programs.map(([, title]) => rust(title!));
  const functions = Object.entries(FUNCTIONS).filter(([, { file }]) => existsSync(inRoot(file)));
  return [...inRust, ...functions.map(([title, { file, name }]) => typescript(title, file, name))];
}

function rust(title: string): Fuzzer {
  const program = `fuzz_${title}`;
  return { title, program, command: [inRoot("target", "fuzz", program)] };
}

function typescript(title: string, file: string, name: string): Fuzzer {
  return { title, command: [process.execPath, inRoot("target", "scripts", "fuzz", "function.js"), file, name] };
}
