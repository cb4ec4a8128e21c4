import { parseArgs } from "node:util";
import { readFileSync } from "node:fs";

import { Problem, inRoot, run } from "../lib/run.js";

interface Asked {
  minutes: number;
  seed: number;
  /** The one fuzzer to run. */
  only?: string;
}

const USAGE = "npm run fuzz -- --minutes 60 --seed 1 [--only NAME]";

/** Reads the arguments. Without `--seed`, the seed is the time. */
export function askedFor(args: string[], names: string[]): Asked {
  const { minutes = "1", seed = String(Math.floor(Date.now() / 1000)), only } = parsed(args);
  if (!(Number(minutes) > 0 && Number.isFinite(Number(minutes)))) {
    throw new Problem(`--minutes is ${minutes}, which is no number above 0.\n${USAGE}`);
  }
  if (!/^\d+$/.test(seed) || !Number.isSafeInteger(Number(seed))) {
    throw new Problem(`--seed is ${seed}, which is no whole number from 0 to 2⁵³ − 1.\n${USAGE}`);
  }
  if (only !== undefined && !names.includes(only)) {
    throw new Problem(`There is no fuzzer "${only}". There are: ${names.join(", ")}.`);
  }
  return { minutes: Number(minutes), seed: Number(seed), ...(only === undefined ? {} : { only }) };
}

function parsed(args: string[]): { minutes?: string; seed?: string; only?: string } {
  const text = { type: "string" } as const;
  try {
    return parseArgs({ args, options: { minutes: text, seed: text, only: text } }).values;
  } catch (error) {
    throw new Problem(`${(error as Error).message}\n${USAGE}`);
  }
}

/**
 * A program that takes `--minutes M --seed N`. For each wrong answer it prints the facts that one needs to repeat it.
 * Its last line is `N tried, M wrong`.
 */
interface Fuzzer {
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

export interface Tally {
  tried: number;
  wrong: number;
}

/** Runs one fuzzer and reads its last line. A crash or a missing count is one wrong case. */
export async function runFuzzer({ title, command }: Fuzzer, minutes: number, seed: number): Promise<Tally> {
  const [program = "", ...args] = command;
  console.log(`… ${title}`);
  const asked = ["--minutes", String(minutes), "--seed", String(seed)];
  const { ok, output } = await run(program, [...args, ...asked], { show: "nothing" });
  const { tried, wrong } = tallyIn(output);
  const counted = { tried, wrong: ok ? wrong : Math.max(wrong, 1) };
  if (counted.wrong > 0) console.log(`--- ${title}:\n${output.trimEnd()}\n---`);
  return counted;
}

/** Reads the last line, `N tried, M wrong`. Without it, adds the lines that end in `N cases, M wrong`. */
export function tallyIn(output: string): Tally {
  const last = /(\d+) tried, (\d+) wrong\s*$/.exec(output);
  const lines = last === null ? [...output.matchAll(/(\d+) cases, (\d+) wrong$/gm)] : [last];
  if (lines.length === 0) return { tried: 0, wrong: 1 };
  const total = (group: number) => lines.reduce((sum, line) => sum + Number(line[group]), 0);
  return { tried: total(1), wrong: total(2) };
}
