// npm run soak [-- --views N --seed N]: re-filters five clouds in workers and compares answers with cold ones
// (tests/soak/refilter.ts). Writes tests/soak/RESULTS.md. Ends with status 1 if an answer was wrong.
import { writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { parseArgs } from "node:util";

import { buildPackage } from "./build/package.js";
import { buildWasm } from "./build/wasm.js";
import { command } from "./lib/command.js";
import { load } from "./lib/load.js";
import { inRoot } from "./lib/paths.js";
import { setUpForBuild } from "./setup/setup.js";

const RESULT = "tests/soak/RESULTS.md";

/** The functions of tests/soak/refilter.ts, which is compiled when it is run. */
interface Refilter {
  soak: (count: number, seed: number, tell: (row: object) => void) => Promise<{ wrong: number }>;
  report: (soak: { wrong: number }, lines: string[]) => string;
}

await command(async () => {
  const text = { type: "string" } as const;
  const { values } = parseArgs({ args: process.argv.slice(3), options: { views: text, seed: text } });
  const [views, seed] = [Number(values.views ?? 20_000), Number(values.seed ?? 20261122)];
  await setUpForBuild();
  await buildWasm();
  await buildPackage();
  const module = await load<Refilter>("tests/soak/refilter.ts");
  const result = await module.soak(views, seed, (row) => {
    console.log(JSON.stringify(row));
  });
  const processor = cpus();
  const lines = [
    `date: ${new Date().toISOString().slice(0, 10)}`,
    `machine: ${processor[0]?.model.trim() ?? "unknown"}, ${processor.length} cores`,
    `versions: Node ${process.versions.node}`,
    `run: \`npm run soak -- --views ${views} --seed ${seed}\``,
  ];
  writeFileSync(inRoot(RESULT), module.report(result, lines));
  console.log(`${result.wrong} wrong (${RESULT})`);
  // Workers of the soak must not keep the process alive.
  process.exit(result.wrong > 0 ? 1 : 0);
});
