// npm test [-- part …]: sets up missing tools, then runs every check, or the checks of the given
// parts. If a check fails, the others still run. The last lines name the failures and add up all
// counts.
import { FAIL, chosenParts, sum, type Check, type Outcome } from "./checks/check.js";
import { Problem, collected, print } from "./lib/run.js";
import { checks } from "./checks/all.js";
import { inOrder, withNeeds } from "./lib/schedule.js";

/** Two cores are busy with three checks: those with a browser wait half of the time, others use one core for long. */
const AT_ONCE = 3;

const rows: string[] = [];
const outcomes = new Map<string, Outcome>();

export async function test(args: string[]): Promise<void> {
  const started = Date.now();
  const parts = chosenParts(args);
  const chosen = withNeeds(checks, ({ part }) => part !== undefined && parts.has(part));
  await inOrder(chosen, AT_ONCE, shown);

  const total = sum([...outcomes.values()]);
  heading("Summary");
  print(`${rows.join("\n")}\n${seconds(started)}  in all\n\n`);
  for (const failure of total.failures) print(`failed: ${failure}\n`);
  print(`${words(total)}\n`);
  if (total.failed > 0) process.exitCode = 1;
}

/** Shows the output of a check after it has ended, so that no other output comes in between. */
async function shown(check: Check): Promise<void> {
  print(`\n… ${check.title}\n`);
  print((await collected(() => recorded(check))).output);
}

async function recorded(check: Check): Promise<void> {
  heading(check.title);
  const began = Date.now();
  const outcome = await tried(check);
  outcomes.set(check.title, outcome);
  const result = outcome.skipped === undefined ? words(outcome) : `skipped: ${outcome.skipped}`;
  if (outcome.skipped !== undefined) print(`${result}\n`);
  rows.push(`${seconds(began)}  ${check.title}: ${result}`);
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
