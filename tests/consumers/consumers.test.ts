// The package as it would be published, installed and used like a user does. Its answers must equal the
// answers of the repository's build. `npm run consumers` sets HPR_CONSUMERS=all and runs more consumers.
import { init, PointCloud } from "hidden-point-removal";
import { afterAll, beforeAll, expect, it } from "vitest";

import { launchBrowser } from "../browser/site";
import { bundlers } from "./bundlers";
import type { Answered, Consumer, Visit } from "./consumer";
import { installPacked } from "./install";
import { nodeScripts } from "./node";
import { otherBrowsers } from "./other-browsers";
import { pages } from "./pages";
import { points, viewpoint } from "./question";
import { visitWith } from "./visit";

const browser = await launchBrowser();
const table: string[] = [];
let expected: number[];

beforeAll(async () => {
  installPacked();
  await init();
  expected = [...new PointCloud(points).visibleFrom(viewpoint).indices];
});

afterAll(async () => {
  await browser.close();
  console.log(table.join("\n"));
});

const visit: Visit = (address) => visitWith(browser, address);

const all: Consumer[] = [
  ...bundlers(visit),
  ...pages(visit, `Chromium ${browser.version()}`),
  ...otherBrowsers,
  ...nodeScripts,
];
const asked = process.env["HPR_CONSUMERS"] === "all" ? all : all.filter(({ further }) => further !== true);

it.for(asked)("$name ($version)", async ({ name, version, lacking, run }, { skip }) => {
  const row = (result: string) => table.push(`${name.padEnd(48)} ${version.padEnd(26)} ${result}`);
  if (lacking !== undefined) {
    row(`not run: ${lacking}`);
    skip(lacking);
  }
  const { error, here, there } = await run().catch((thrown: unknown): Answered => ({ error: String(thrown) }));
  const right = error === undefined && String(here) === String(expected) && String(there) === String(expected);
  row(right ? "same answer" : "FAILED");
  expect(error).toBeUndefined();
  // The lists themselves are not compared by `expect`: their difference would fill the screen.
  expect(right, `answered ${here?.length} and ${there?.length} points, not ${expected.length}`).toBe(true);
});
