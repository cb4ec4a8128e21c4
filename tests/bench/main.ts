// npm run bench. Its arguments are in options.ts.
//
// Milliseconds are medians of one run on one machine; compare ratios. Engines are timed in turns, which tinybench and
// mitata cannot do: on a machine that others use, too, only ratios of neighbors in time mean anything.

import { init } from "hidden-point-removal";

import { CLOUDS, type Cloud } from "./clouds.js";
import { timeFrames } from "./frames.js";
import { describeMachine } from "./machine.js";
import { timeMaps } from "./maps.js";
import { readOctrees } from "./octrees.js";
import { type BenchOptions, readOptions, type Section, USAGE } from "./options.js";
import { peers } from "./peers.js";
import { markdown, type Table } from "./report.js";
import { timeQueries } from "./speed.js";
import { timeWorkers } from "./workers.js";

const args = process.argv.slice(2);
const options = optionsOrExit();
await init();

const others = options.sections.has("speed") ? peers(options.peers) : [];
const sections: Record<Section, () => Table[] | Promise<Table[]>> = {
  speed: () => timeQueries(chosenClouds(), others),
  maps: async () => [timeMaps(), await timeFrames()],
  workers: async () => [await timeWorkers()],
  octrees: async () => [await readOctrees()],
};
const tables: Table[] = [];
for (const section of options.sections) tables.push(...(await sections[section]()));

const machine = describeMachine(others);
console.log(options.json ? JSON.stringify({ machine, tables }, undefined, 2) : textOf(tables));

function textOf(tables: Table[]): string {
  return [
    "# Measured\n",
    ...Object.entries(machine).map(([what, value]) => `- ${what}: ${value}`),
    `- command: \`${["npm run bench", ...(args.length === 0 ? [] : ["--", ...args])].join(" ")}\`\n`,
    ...tables.map(markdown).filter((table) => table !== ""),
  ].join("\n");
}

function optionsOrExit(): BenchOptions {
  try {
    return readOptions(args);
  } catch (error) {
    console.error(`${error instanceof Error ? error.message : String(error)}\n\n${USAGE}`);
    process.exit(2);
  }
}

/** Makes one cloud at a time, so that the large ones are never in memory together. */
function* chosenClouds(): Generator<Cloud> {
  for (const name of options.clouds) {
    const cloud = CLOUDS[name]!();
    if (cloud !== undefined) yield cloud;
  }
}
