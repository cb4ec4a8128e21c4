// npm run soak [-- --views N --seed N]: first the long form of the page's soak (tests/browser/soak.test.ts). Then re-filters
// five clouds in workers and compares answers with cold ones (tests/soak/refilter.ts). Ends
// with status 1 if the page's memory has grown, or if an answer was wrong.
import { cpus } from "node:os";
import { parseArgs } from "node:util";

import { build } from "./build/build.js";
import { command } from "./lib/command.js";
import { load } from "./lib/load.js";
import { run } from "./lib/run.js";
import { setUpBrowser } from "./setup/browser.js";
import { setUpForBuild } from "./setup/setup.js";

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
  await build();
  const browser = { HPR_CHROMIUM: await setUpBrowser(), HPR_SOAK: "1" };
  const page = await run("vitest", ["run", "tests/browser/soak.test.ts"], { show: "results", env: browser });
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
  console.log(module.report(result, lines));
  // Workers of the soak must not keep the process alive.
  process.exit(page.ok && result.wrong === 0 ? 0 : 1);
});
