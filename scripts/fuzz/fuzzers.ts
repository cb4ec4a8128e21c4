import { readFileSync } from "node:fs";

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
};

/** Every check of tests/core/checks, every other Rust program `fuzz_…` of tests/Cargo.toml, and the functions. */
export function allFuzzers(): Fuzzer[] {
  const checks = named("tests/core/checks/mod.rs", /^ {4}check\("(\w+)"/gm).map((title) => rust(title, "fuzz_core"));
  const programs = named("tests/Cargo.toml", /^name = "fuzz_(?!core)(\w+)"$/gm).map((title) => rust(title));
  return [...checks, ...programs, ...Object.entries(FUNCTIONS).map(([title, it]) => typescript(title, it))];
}

function named(file: string, pattern: RegExp): string[] {
  return [...readFileSync(inRoot(file), "utf8").matchAll(pattern)].map(([, title]) => title!);
}

function rust(title: string, program = `fuzz_${title}`): Fuzzer {
  const check = program === "fuzz_core" ? ["--check", title] : [];
  return { title, program, command: [inRoot("target", "fuzz", program), ...check] };
}

function typescript(title: string, { file, name }: { file: string; name: string }): Fuzzer {
  return { title, command: [process.execPath, inRoot("target", "scripts", "fuzz", "function.js"), file, name] };
}
