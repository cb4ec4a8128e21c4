// npm run mutants -- [--files GLOB]... [--shard K/N] [--quick]: changes one place of the core at a time, by
// cargo-mutants, and checks that a test fails. Mutants that were tried before are not tried again, so
// the command can be stopped at any time. Writes tests/mutations/rust.tsv and the table of RUST.md there.
import { parseArgs } from "node:util";

import { command } from "./lib/command.js";
import { Problem } from "./lib/run.js";
import { setUpLinker } from "./setup/linker.js";
import { setUpRust } from "./setup/rust.js";
import { setUpCargoMutants } from "./mutants/install.js";
import { fileOf, readResults, saveResults, writeTable } from "./mutants/results.js";
import type { Tests } from "./mutants/try.js";
import { allTests, checkTests, listMutants, quickTests, tryMutants } from "./mutants/try.js";
import { copyTree } from "./mutants/tree.js";

/** The number of mutants for one start of cargo-mutants. A small batch loses less at a stop. A large one is faster. */
const BATCH = 5;

await command(async () => {
  const { files, shard, quick } = askedFor(process.argv.slice(3));
  await setUpRust();
  await setUpLinker();
  await setUpCargoMutants();
  copyTree();
  const every = await listMutants([], undefined);
  const chosen = await listMutants(files, shard);
  const results = readResults();
  const tryAll = async (isDue: (name: string) => boolean, tests: Tests) => {
    const due = chosen.filter(isDue);
    if (due.length === 0) return;
    console.log(`${due.length} of ${chosen.length} mutants to try with ${tests.title}`);
    await checkTests(tests);
    for (let start = 0; start < due.length; start += BATCH) {
      const batch = due.slice(start, start + BATCH);
      for (const [name, result] of await tryMutants(batch, tests)) {
        results.set(name, result);
        console.log(`${result.padEnd(8)} ${name}`);
      }
      saveResults(results, every);
    }
  };
  // Running all tests is slow, and only few mutants need it. These mutants come last.
  const isNew = (name: string) => !results.has(name);
  for (const [pattern, tests] of quickTests) {
    await tryAll((name) => isNew(name) && pattern.test(fileOf(name)), tests);
  }
  if (!quick) await tryAll((name) => results.get(name) === "open", allTests);
  writeTable(results, every);
});

interface Asked {
  files: string[];
  shard: string | undefined;
  /** Whether mutants that the quick tests miss are left open. */
  quick: boolean;
}

function askedFor(args: string[]): Asked {
  const usage = "npm run mutants -- [--files 'src/hull/*.rs']... [--shard 0/8] [--quick]";
  try {
    const text = { type: "string" } as const;
    const options = { files: { ...text, multiple: true }, shard: text, quick: { type: "boolean" } } as const;
    const { files = [], shard, quick = false } = parseArgs({ args, options }).values;
    const [, part, count] = /^(\d+)\/(\d+)$/.exec(shard ?? "0/1") ?? [];
    if (part === undefined || Number(part) >= Number(count)) throw new Error(`--shard ${shard} is no part of a whole.`);
    return { files, shard, quick };
  } catch (error) {
    throw new Problem(`${(error as Error).message}\n${usage}`);
  }
}
