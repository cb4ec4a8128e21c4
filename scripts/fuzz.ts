// npm run fuzz -- --minutes M --seed N [--only NAME]: runs every fuzzer of tests/fuzz for its share of
// the minutes. Prints how many cases were tried and how many were wrong. Ends with status 1 if any was wrong.
import { availableParallelism } from "node:os";

import { allFuzzers, askedFor, runFuzzer } from "./fuzz/fuzzers.js";
import { buildPackage } from "./build/build.js";
import { mustRun } from "./lib/run.js";
import { inOrder } from "./lib/schedule.js";

export async function fuzz(args: string[]): Promise<void> {
  const fuzzers = allFuzzers();
  const { minutes, seed, only } = askedFor(
    args,
    fuzzers.map(({ title }) => title),
  );
  const chosen = fuzzers.filter(({ title }) => only === undefined || title === only);
  if (chosen.some(({ isRust }) => !isRust)) {
    await buildPackage();
  }
  if (chosen.some(({ isRust }) => isRust)) {
    const args = ["build", "--locked", "--profile", "fuzz", "--package", "hpr-tests", "--bin", "fuzz_core"];
    await mustRun("cargo", args, "The fuzzer does not build");
  }

  const atOnce = Math.min(availableParallelism(), chosen.length);
  const share = (minutes * atOnce) / chosen.length;
  console.log(`seed ${seed}, ${minutes} minutes: ${share.toFixed(2)} for each of ${chosen.length} fuzzers\n`);
  const rows: string[] = [];
  let wrong = 0;
  await inOrder(chosen, atOnce, async (fuzzer) => {
    const report = await runFuzzer(fuzzer, share, seed);
    wrong += report.wrong;
    rows.push(
      `${fuzzer.title.padEnd(16)} ${report.tried.toLocaleString("en").padStart(14)} tried ${report.wrong} wrong`,
    );
  });
  console.log(`\n${rows.sort().join("\n")}\n\n${wrong === 0 ? "nothing was wrong" : `${wrong} wrong`} (seed ${seed})`);
  if (wrong > 0) process.exitCode = 1;
}
