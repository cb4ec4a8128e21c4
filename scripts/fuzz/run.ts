import { run } from "../lib/run.js";
import type { Fuzzer } from "./fuzzers.js";

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
