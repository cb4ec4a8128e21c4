// npm run fidelity: prints how often answers are wrong, as Markdown. `--real` scores labeled scans instead of meshes; names
// after it choose clouds by a part of their name.
import { parseArgs } from "node:util";

import { init } from "hidden-point-removal";

import { markdown, type Table } from "../bench/report.js";
import { traceAgain } from "./agreement.js";
import { realTables } from "./real-tables.js";
import { EXPLAINED, fidelityTables } from "./tables.js";

const { values, positionals } = parseArgs({
  options: { real: { type: "boolean", default: false } },
  allowPositionals: true,
});
await init();
const tables = values.real ? realTables(positionals, console.error) : await meshes();
if (tables.length === 0) {
  console.error("There are no labeled scans: set HPR_SHARED to the directory that holds them.");
  process.exitCode = 1;
}
console.log(tables.map(markdown).join("\n"));

async function meshes(): Promise<Table[]> {
  const agreement = traceAgain(console.error);
  if (agreement !== undefined) {
    const [same, labels] = [agreement.same, agreement.labels].map((count) => count.toLocaleString("en-US"));
    console.error(`${same!} of ${labels!} labels of ${agreement.name} are those of another ray tracer.`);
  }
  console.log(`${EXPLAINED}\n`);
  return await fidelityTables(console.error);
}
