import { run } from "../lib/run.js";
import type { Job } from "../lib/schedule.js";
import type { Part } from "./parts.js";

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
  locks?: "debug" | "fuzz" | "wasm";
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
