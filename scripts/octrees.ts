// npm run octrees [-- --points N]: a generated octree of 2 million points, streamed from four viewpoints and compared
// with the same cloud in one piece (tests/soak/octrees.ts). Writes the table of docs/STREAM.md.
import { readFileSync, writeFileSync } from "node:fs";
import { parseArgs } from "node:util";

import { buildPackage } from "./build/package.js";
import { buildWasm } from "./build/wasm.js";
import { command } from "./lib/command.js";
import { load } from "./lib/load.js";
import { inRoot } from "./lib/paths.js";
import { Problem } from "./lib/run.js";
import { setUpForBuild } from "./setup/setup.js";

const RESULT = "docs/STREAM.md";
const TABLE = /(<!-- npm run octrees -->\n)[^]*?(<!-- end -->)/;
const POINTS = 2_000_000;

interface Octrees {
  report: (points: number) => Promise<{ table: string; different: string[] }>;
}

await command(async () => {
  const { points } = parseArgs({ args: process.argv.slice(3), options: { points: { type: "string" } } }).values;
  const count = Number(points ?? POINTS);
  if (!Number.isSafeInteger(count) || count < 1000) throw new Problem("npm run octrees -- --points 2000000");
  await setUpForBuild();
  await buildWasm();
  await buildPackage();
  const module = await load<Octrees>("tests/soak/octrees.ts");
  const { table, different } = await module.report(count);
  console.log(table);
  if (different.length > 0) throw new Problem(`The octree answers otherwise than one piece: ${different.join(", ")}.`);
  // Other sizes are only shown.
  if (count !== POINTS) return;
  const text = readFileSync(inRoot(RESULT), "utf8");
  writeFileSync(
    inRoot(RESULT),
    text.replace(TABLE, (_, start: string, end: string) => `${start}\n${table}\n${end}`),
  );
  console.log(RESULT);
});
