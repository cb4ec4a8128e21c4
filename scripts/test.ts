// npm test: sets up whatever is missing, then runs every check. A check that
// fails does not keep the others from running; the last lines name what failed
// and add everything up.
import { buildCheck } from "./checks/build.js";
import type { Check, Outcome } from "./checks/check.js";
import { FAIL, PASS, sum } from "./checks/check.js";
import { packagingChecks } from "./checks/packaging.js";
import { rustChecks } from "./checks/rust.js";
import { pageCheck, typescriptChecks } from "./checks/typescript.js";
import { command } from "./lib/command.js";
import { collected, print } from "./lib/output.js";
import { Problem } from "./lib/run.js";
import { setUpForChecks } from "./setup/setup.js";

const setUpCheck: Check = {
  title: "Set-up",
  run: async () => {
    await setUpForChecks();
    return PASS;
  },
};

/** Two rows of checks beside each other: most use one core, and cargo keeps others of its kind waiting. */
const BESIDE = [
  [...rustChecks, pageCheck],
  [...typescriptChecks, ...packagingChecks],
];

const rows: string[] = [];
const outcomes = new Map<string, Outcome>();

await command(async () => {
  const started = Date.now();
  if ((await outcomeOf(setUpCheck)).failed === 0) {
    await outcomeOf(buildCheck);
    await Promise.all(BESIDE.map(inTurn));
  }

  const total = sum([...outcomes.values()]);
  heading("Summary");
  print(`${rows.join("\n")}\n${seconds(started)}  in all\n\n`);
  for (const failure of total.failures) print(`failed: ${failure}\n`);
  print(`${words(total)}\n`);
  if (total.failed > 0) process.exitCode = 1;
});

/** Shows what each check prints when it has ended, so that nothing else comes in between. */
async function inTurn(checks: Check[]): Promise<void> {
  for (const check of checks) {
    print(`\n… ${check.title}\n`);
    print((await collected(() => outcomeOf(check))).output);
  }
}

async function outcomeOf(check: Check): Promise<Outcome> {
  heading(check.title);
  const began = Date.now();
  const outcome = await tried(check);
  outcomes.set(check.title, outcome);
  rows.push(`${seconds(began)}  ${check.title}: ${words(outcome)}`);
  return outcome;
}

async function tried(check: Check): Promise<Outcome> {
  const lacking = check.needs?.find((title) => outcomes.get(title)?.failed !== 0);
  if (lacking !== undefined) {
    print(`Not run, because this failed: ${lacking}\n`);
    return FAIL;
  }
  try {
    return await check.run();
  } catch (error) {
    print(`${error instanceof Problem ? error.message : ((error as Error).stack ?? String(error))}\n`);
    return FAIL;
  }
}

function heading(title: string): void {
  print(`\n=== ${title} ===\n`);
}

function words({ passed, failed }: Outcome): string {
  return `${passed} passed, ${failed} failed`;
}

function seconds(since: number): string {
  return `${((Date.now() - since) / 1000).toFixed(1)} s`.padStart(8);
}
