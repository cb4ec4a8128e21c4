// npm run bench. Its arguments are in options.ts.
//
// Milliseconds are medians of one run on one machine; compare ratios. Engines are timed in turns, which tinybench and
// mitata cannot do: on a machine that others use, too, only ratios of neighbors in time mean anything.

import { init } from "hidden-point-removal";

import { timeAdapter } from "./adapter.js";
import { fidelityTables } from "../fidelity/tables.js";
import { type BrowserEngine, openChromium } from "./chromium.js";
import { CLOUDS, type Cloud } from "./clouds.js";
import { timeDrafts } from "./drafts.js";
import { localEngines } from "./engines.js";
import { describeMachine } from "./machine.js";
import { timeNodes } from "./nodes.js";
import { type BenchOptions, readOptions, USAGE } from "./options.js";
import { measurePage } from "./page/page.js";
import { peers } from "./peers.js";
import { markdown, type Table } from "./report.js";
import { timeSectors } from "./sectors.js";
import { timeQueries } from "./speed.js";
import { timeWorkers } from "./workers.js";

const args = process.argv.slice(2);
const options = optionsOrExit();
await init();

const tables: Table[] = [];
const others = options.sections.has("speed") ? peers(options.peers) : [];
const browser = options.sections.has("speed") ? await openChromium() : undefined;
try {
  if (options.sections.has("speed")) tables.push(...(await timeQueries(chosenClouds(), enginesWith(browser), others)));
  if (options.sections.has("drafts")) tables.push(timeDrafts());
  if (options.sections.has("workers")) tables.push(...[await timeWorkers()].filter((table) => table !== undefined));
  if (options.sections.has("sectors")) tables.push(timeSectors());
  if (options.sections.has("adapter")) tables.push(await timeAdapter(), await timeNodes());
  if (options.sections.has("fidelity")) tables.push(...(await fidelityTables(console.error)));
} finally {
  await browser?.close();
}

const demo = options.sections.has("page") ? await measurePage() : undefined;

const machine = describeMachine(demo?.chromium ?? browser?.version, others);
const all = [...tables, ...(demo?.tables ?? [])];
console.log(options.json ? JSON.stringify({ machine, tables: all }, undefined, 2) : textOf(all));

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

function enginesWith(chromium: BrowserEngine | undefined) {
  return chromium === undefined ? localEngines() : [...localEngines(), chromium];
}
