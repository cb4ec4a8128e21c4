import { run } from "../lib/run.js";

/** How many tests a check ran; a check that is one yes or no counts as one. */
export interface Outcome {
  passed: number;
  failed: number;
  /** What failed, by name, with the first line of why, as far as the check can tell. */
  failures?: string[];
}

/** One heading of `npm test`. */
export interface Check {
  title: string;
  /** Titles of the checks this one makes no sense without. */
  needs?: string[];
  run: () => Promise<Outcome>;
}

export const PASS: Outcome = { passed: 1, failed: 0 };
export const FAIL: Outcome = { passed: 0, failed: 1 };

/** A command that counts as one check. */
export async function checkCommand(name: string, args: string[], env: Record<string, string> = {}): Promise<Outcome> {
  return (await run(name, args, { show: "results", env })).ok ? PASS : FAIL;
}

/** Several outcomes as one. */
export function sum(outcomes: Outcome[]): Required<Outcome> {
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
