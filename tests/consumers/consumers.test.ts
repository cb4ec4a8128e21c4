// The package as it would be published, installed and used like a user does. Its answers must equal the
// answers of the repository's build. `npm run consumers` sets HPR_CONSUMERS=all and runs more consumers.
import { rmSync } from "node:fs";

import { init, PointCloud } from "hidden-point-removal";
import { afterAll, beforeAll, expect, it } from "vitest";

import { launchBrowser } from "../browser/site";
import { missingGlue, realApps } from "./apps";
import { bundlers } from "./bundlers";
import type { Answered, Consumer, Visit } from "./consumer";
import { installPacked } from "./install";
import { type Row, writeMatrix } from "./matrix";
import { nodeScripts } from "./node";
import { pages } from "./pages";
import { points, viewpoint } from "./question";
import { visitWith } from "./visit";

const browser = await launchBrowser();
const rows: Row[] = [];
const everything = process.env["HPR_CONSUMERS"] === "all";
let expected: number[];

beforeAll(async () => {
  installPacked();
  await init();
  expected = [...new PointCloud(points).visibleFrom(viewpoint).indices];
});

afterAll(async () => {
  await browser.close();
  if (everything) writeMatrix(rows);
});

const visit: Visit = (address) => visitWith(browser, address);

const all: Consumer[] = [
  ...bundlers(visit),
  ...realApps(visit),
  ...pages(visit, `Chromium ${browser.version()}`),
  ...nodeScripts,
];
const asked = everything ? all : all.filter(({ further }) => further !== true);

it.for(asked)("$name ($version)", async (consumer, { skip }) => {
  const { lacking, prepare, run } = consumer;
  const row: Row = { consumer };
  rows.push(row);
  if (lacking !== undefined) skip(lacking);
  const folder = prepare?.();
  const start = performance.now();
  const { error, here, there } = await answered(run, folder ?? "");
  row.seconds = (performance.now() - start) / 1000;
  row.works = error === undefined && String(here) === String(expected) && String(there) === String(expected);
  if (folder !== undefined) rmSync(folder, { recursive: true, force: true, maxRetries: 5 });
  expect(error).toBeUndefined();
  // The lists themselves are not compared by `expect`: their difference would fill the screen.
  expect(row.works, `answered ${here?.length} and ${there?.length} points, not ${expected.length}`).toBe(true);
});

/** The answer. If a program fails, the error has its output. */
async function answered(run: Consumer["run"], folder: string): Promise<Answered> {
  try {
    return await run(folder);
  } catch (thrown) {
    const { stdout, stderr } = thrown as { stdout?: string; stderr?: string };
    return { error: [String(thrown), stdout, stderr].filter(Boolean).join("\n") };
  }
}

it("each line of glue that is counted stands in its app", () => {
  expect(missingGlue()).toEqual([]);
});
