// npm test: sets up whatever is missing, then runs every check. A check that
// fails does not keep the others from running; the last line adds them up.
import type { Check, Outcome } from "./checks/check.js";
import { FAIL, PASS, sum } from "./checks/check.js";
import { buildCheck } from "./checks/build.js";
import { packagingChecks } from "./checks/packaging.js";
import { rustChecks } from "./checks/rust.js";
import { typescriptChecks } from "./checks/typescript.js";
import { command } from "./lib/command.js";
import { Problem } from "./lib/run.js";
import { setUpForChecks } from "./setup/setup.js";

const setUpCheck: Check = {
  title: "Set-up",
  vital: true,
  run: async () => {
    await setUpForChecks();
    return PASS;
  },
};

const CHECKS: Check[] = [setUpCheck, ...rustChecks, buildCheck, ...typescriptChecks, ...packagingChecks];

await command(async () => {
  const started = Date.now();
  const rows: string[] = [];
  const outcomes = new Map<string, Outcome>();
  for (const check of CHECKS) {
    heading(check.title);
    const began = Date.now();
    const outcome = await outcomeOf(check, outcomes);
    outcomes.set(check.title, outcome);
    rows.push(`${seconds(began)}  ${check.title}: ${words(outcome)}`);
    if (check.vital && outcome.failed > 0) break;
  }

  heading("Summary");
  console.log(rows.join("\n"));
  console.log(`${seconds(started)}  in all\n`);
  const total = sum([...outcomes.values()]);
  console.log(words(total));
  if (total.failed > 0) process.exitCode = 1;
});

async function outcomeOf(check: Check, before: Map<string, Outcome>): Promise<Outcome> {
  const lacking = check.needs?.find((title) => before.get(title)?.failed !== 0);
  if (lacking !== undefined) {
    console.log(`Not run, because this failed: ${lacking}`);
    return FAIL;
  }
  try {
    return await check.run();
  } catch (error) {
    console.log(error instanceof Problem ? error.message : error);
    return FAIL;
  }
}

function heading(title: string): void {
  console.log(`\n=== ${title} ===`);
}

function words({ passed, failed }: Outcome): string {
  return `${passed} passed, ${failed} failed`;
}

function seconds(since: number): string {
  return `${((Date.now() - since) / 1000).toFixed(1)} s`.padStart(8);
}
