import { run } from "../lib/run.js";
import { python, setUpPython } from "../setup/python.js";
import { BUILD } from "./build.js";
import type { Check, Outcome } from "./check.js";
import { counted } from "./check.js";

export const pythonCheck: Check = {
  title: "Python package",
  part: "python",
  // The answers are compared with those of the npm package.
  needs: [BUILD],
  run: async () => {
    // The tests of Dask, LAZ and Parquet skip themselves without their packages. `npm run test:scale` installs these.
    const lacking = await setUpPython(["scipy>=1.11", "mypy>=1.11"]);
    return lacking === undefined ? pytest("python/tests") : { passed: 0, failed: 0, skipped: lacking };
  },
};

/** Runs Python tests and reads the counts from the last line. `left` is how many tests skipped themselves. */
export async function pytest(...args: string[]): Promise<Outcome & { left: number }> {
  const { ok, output } = await run(python, ["-m", "pytest", "-q", "-p", "no:cacheprovider", ...args], {
    show: "results",
  });
  const count = (word: string): number => Number(new RegExp(`(\\d+) ${word}`).exec(output)?.[1] ?? 0);
  const counts = { passed: count("passed"), failed: count("failed") + count("errors?") };
  return { ...counted(ok, counts), left: count("skipped") };
}
