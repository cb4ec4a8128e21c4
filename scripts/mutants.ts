// npm run mutants -- [--files PATH]... [--shard K/N] [--quick] [--tests NAME]... [--open] [--jobs N]: changes one place
// of the core at a time and checks that a test fails. All mutants are compiled into one program. Mutants that were tried
// before are not tried again, so the command can be stopped at any time. Writes tests/mutations/rust.tsv and the table of
// RUST.md.
import { parseArgs } from "node:util";

import { command } from "./lib/command.js";
import { Problem } from "./lib/run.js";
import { inOrder } from "./lib/schedule.js";
import { setUpLinker } from "./setup/linker.js";
import { setUpRust } from "./setup/rust.js";
import { setUpCargoMutants } from "./mutants/install.js";
import type { Mutant } from "./mutants/list.js";
import { listMutants } from "./mutants/list.js";
import { buildPrograms } from "./mutants/programs.js";
import { readResults, saveResults, writeTable } from "./mutants/results.js";
import type { Choice } from "./mutants/tests.js";
import { measureTests } from "./mutants/tests.js";
import { Trial } from "./mutants/try.js";

await command(async () => {
  const { files, shard, choice, open, jobs } = askedFor(process.argv.slice(3));
  await setUpRust();
  await setUpLinker();
  await setUpCargoMutants();
  const every = await listMutants();
  const inShard = every.filter((_, index) => index % shard.count === shard.part);
  // Files are tried in the order in which they are named.
  const chosen = new Set(files.flatMap((path) => inShard.filter(({ file }) => file.startsWith(path))));

  const results = readResults();
  const { paths, placed, unviable } = await buildPrograms();
  const numberOf = new Map(every.map((mutant, index) => [mutant, index + 1]));
  for (const mutant of every) {
    if (unviable.has(numberOf.get(mutant)!)) results.set(mutant.key, "unviable");
    else if (results.get(mutant.key) === "unviable") results.delete(mutant.key);
  }
  const isAll = !choice.quick;
  const isDue = ({ key }: Mutant) =>
    (!open && results.get(key) === undefined) || (isAll && results.get(key) === "open");
  const due = [...chosen].filter((mutant) => isDue(mutant) && placed.has(numberOf.get(mutant)!));
  const tests = due.length === 0 ? [] : await measureTests(paths, choice);

  console.log(`${due.length} of ${chosen.size} mutants to try`);
  const trial = new Trial(tests);
  const tries = due.map((mutant) => ({ title: mutant.name, ...mutant }));
  const numbers = new Map(due.map((mutant) => [mutant.key, numberOf.get(mutant)!]));
  await inOrder(tries, jobs, async ({ name, file, key }) => {
    const result = await trial.run(numbers.get(key)!, file, choice);
    results.set(key, result);
    console.log(`${result.padEnd(9)} ${name}`);
    saveResults(results, every);
  });
  saveResults(results, every);
  writeTable(results, every);
});

interface Asked {
  /** The beginnings of the paths of the files. */
  files: string[];
  /** Every mutant whose place in the list has this remainder. */
  shard: { part: number; count: number };
  choice: Choice;
  /** Whether only mutants are tried that earlier tests missed. */
  open: boolean;
  /** How many mutants are tried at a time. */
  jobs: number;
}

function askedFor(args: string[]): Asked {
  const usage =
    "npm run mutants -- [--files src/hull]... [--shard 0/8] [--quick] [--tests sectors::]... [--open] [--jobs 2]";
  try {
    const text = { type: "string" } as const;
    const options = {
      files: { ...text, multiple: true },
      shard: text,
      quick: { type: "boolean" },
      tests: { ...text, multiple: true },
      open: { type: "boolean" },
      jobs: text,
    } as const;
    const given = parseArgs({ args, options }).values;
    const { files = ["src"], shard = "0/1", quick = false, tests: names = [], open = false, jobs = "1" } = given;
    const [, part, count] = /^(\d+)\/(\d+)$/.exec(shard) ?? [];
    if (part === undefined || Number(part) >= Number(count)) throw new Error(`--shard ${shard} is no part of a whole.`);
    if (!/^[1-9]\d?$/.test(jobs)) throw new Error(`--jobs ${jobs} is no number from 1 to 99.`);
    const choice = { quick, names };
    return { files, shard: { part: Number(part), count: Number(count) }, choice, open, jobs: Number(jobs) };
  } catch (error) {
    throw new Problem(`${(error as Error).message}\n${usage}`);
  }
}
