import { run } from "../lib/run.js";
import type { Job } from "../lib/schedule.js";
import type { Part } from "./parts.js";

/** How many tests a check ran; a check that is one yes or no counts as one. */
export interface Outcome {
  passed: number;
  failed: number;
  /** The names of failed tests, each with the first line of its message, as far as the check can tell. */
  failures?: string[];
  /** Why the check ran nothing, where this machine or this repository lacks something. */
  skipped?: string;
}

/** One heading of `npm test`. */
export interface Check extends Job {
  /** With no part, a check runs only where a chosen one needs it. */
  part: Part | undefined;
  /** The folder of target/ that cargo locks: two cargo commands that share one would wait for each other. */
  locks?: "debug" | "fuzz" | "wasm";
  run: () => Promise<Outcome>;
}

export const PASS: Outcome = { passed: 1, failed: 0 };
export const FAIL: Outcome = { passed: 0, failed: 1 };

/** A command that counts as one check. */
export async function checkCommand(name: string, args: string[], env: Record<string, string> = {}): Promise<Outcome> {
  return (await run(name, args, { show: "results", env })).ok ? PASS : FAIL;
}

/** Several outcomes as one. */
export function sum(outcomes: Outcome[]): Required<Omit<Outcome, "skipped">> {
  return {
    passed: outcomes.reduce((total, one) => total + one.passed, 0),
    failed: outcomes.reduce((total, one) => total + one.failed, 0),
    failures: outcomes.flatMap(({ failures = [] }) => failures),
  };
}

/**
 * The tests a command counted, but never a success for a command that failed
 * (it may have crashed between two tests), nor for one that ran no test at all.
 */
export function counted(ok: boolean, counts: Outcome): Outcome {
  const wrong = !ok || counts.passed === 0;
  return { ...counts, failed: Math.max(counts.failed, wrong ? 1 : 0) };
}
