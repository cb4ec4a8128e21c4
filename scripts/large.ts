// npm run large [-- --points N]...: one large cloud from end to end (tests/soak/large.ts), 10 and 30 million points if
// no number is given.
import { cpus, loadavg, totalmem } from "node:os";
import { parseArgs } from "node:util";

import { buildPackage } from "./build/package.js";
import { buildWasm } from "./build/wasm.js";
import { command } from "./lib/command.js";
import { load } from "./lib/load.js";
import { inRoot } from "./lib/paths.js";
import { Problem } from "./lib/run.js";
import { setUpForBuild } from "./setup/setup.js";

interface Stage {
  name: string;
  result: string;
  seconds: number;
  cpu: number;
  held: number | undefined;
  peak: number | undefined;
}

interface Large {
  large: (points: number, folder: string, tell: (stage: Stage) => void) => Promise<Stage[]>;
}

await command(async () => {
  const { points } = parseArgs({
    args: process.argv.slice(3),
    options: { points: { type: "string", multiple: true } },
  }).values;
  const counts = (points ?? ["10000000", "30000000"]).map(Number);
  if (!counts.every((count) => Number.isSafeInteger(count) && count > 0)) {
    throw new Problem("npm run large -- --points 10000000");
  }
  await setUpForBuild();
  await buildWasm();
  await buildPackage();
  const module = await load<Large>("tests/soak/large.ts");
  const parts: string[] = [];
  for (const count of counts) {
    console.log(`${count.toLocaleString("en")} points`);
    const stages = await module.large(count, inRoot("target", "large"), ({ name, result, seconds, peak }) => {
      console.log(`${seconds.toFixed(1).padStart(7)} s  ${peak?.toFixed(0) ?? "?"} MB  ${name}: ${result}`);
    });
    parts.push(`## ${count.toLocaleString("en")} points\n\n${table(stages)}`);
  }
  console.log(`${head()}\n${parts.join("\n\n")}`);
});

function head(): string {
  const processor = cpus();
  const gigabytes = (totalmem() / 2 ** 30).toFixed(0);
  return `# Large clouds from end to end

Written by \`npm run large\`: a bumpy surface around the origin, seen from outside, single precision.

- date: ${new Date().toISOString().slice(0, 10)}
- machine: ${processor[0]?.model.trim() ?? "unknown"}, ${processor.length} cores, ${gigabytes} GB, load ${loadavg()[0]!.toFixed(0)} at the end
- versions: Node ${process.versions.node}

Megabytes of the whole process, with Node itself: after the stage, and at most during it. The command is a process of its own.
`;
}

function table(stages: Stage[]): string {
  const number = (value: number | undefined, digits: number) => value?.toFixed(digits) ?? "";
  const rows = stages.map(({ name, result, seconds, cpu, held, peak }) =>
    [name, result, number(seconds, 1), number(cpu, 1), number(held, 0), number(peak, 0)].join(" | "),
  );
  return [
    "stage | result | seconds | seconds of all cores | MB after | MB at most",
    "---|---|---:|---:|---:|---:",
    ...rows,
  ]
    .map((row) => `| ${row} |`)
    .join("\n");
}
