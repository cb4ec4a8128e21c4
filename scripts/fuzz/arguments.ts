import { parseArgs } from "node:util";

import { Problem } from "../lib/run.js";

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
