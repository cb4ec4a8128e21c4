import { readFileSync } from "node:fs";

import { inRoot } from "../lib/paths.js";

/**
 * A program that takes `--minutes M --seed N`. For each wrong answer it prints the facts that one needs to repeat it.
 * Its last line is `N tried, M wrong`.
 */
export interface Fuzzer {
  title: string;
  /** True of the checks of `fuzz_core`. */
  isRust?: true;
  command: string[];
}

/** Functions of TypeScript files, `(minutes, seed) => Promise<{ tried, wrong } | wrong>`, by title. */
const FUNCTIONS: Record<string, { file: string; name: string }> = {
  files: { file: "tests/fuzz/files.ts", name: "fuzzFiles" },
  foreign: { file: "tests/fuzz/foreign.ts", name: "fuzzForeign" },
  border: { file: "tests/fuzz/border.ts", name: "fuzzBorder" },
  stream: { file: "tests/fuzz/stream.ts", name: "fuzzStream" },
};

/** Every check of tests/core/checks, and the functions. */
export function allFuzzers(): Fuzzer[] {
  const checks = readFileSync(inRoot("tests/core/checks/mod.rs"), "utf8").matchAll(/^ {4}check\("(\w+)"/gm);
  return [
    ...[...checks].map(([, title]) => rust(title!)),
    ...Object.entries(FUNCTIONS).map(([title, it]) => typescript(title, it)),
  ];
}

function rust(title: string): Fuzzer {
  return { title, isRust: true, command: [inRoot("target", "fuzz", "fuzz_core"), "--check", title] };
}

function typescript(title: string, { file, name }: { file: string; name: string }): Fuzzer {
  return {
    title,
    command: [process.execPath, inRoot("target", "scripts", "fuzz", "function.js"), file, name],
  };
}
