// How soon the picture follows the camera, for clouds of several sizes.
import type { Browser } from "playwright-core";

import { binaryPly } from "../../browser/clouds.js";
import { bumpySurface } from "../generators.js";
import { median, type Row, type Table } from "../report.js";
import { drag, newContext, ready, upToDate, watchedBy, watchedPage } from "./visit.js";

const SECONDS = 8;
const STEPS = 9;
/** The camera rests for this long before each step, in milliseconds. */
const REST = 300;
/** The points of the generated clouds. */
const SIZES = [1_000_000, 3_000_000, 10_000_000];

/** `files` are those of the server at `address`. */
export async function timeFollowing(browser: Browser, address: string, files: Map<string, Uint8Array>): Promise<Table> {
  const rows = [await follow(browser, "dragon", `${address}?sample=dragon`)];
  for (const count of SIZES) {
    // The server holds one large cloud at a time.
    files.set("bumpy.ply", binaryPly(bumpySurface(count, 4), "float", true));
    rows.push(await follow(browser, "bumpy sphere", `${address}?src=bumpy.ply`));
  }
  files.clear();
  const note =
    `Answers a second while the mouse turns the cloud for ${SECONDS} seconds and every frame asks: drafts, and exact ones. Then ${STEPS} steps by key, each from a camera at rest: milliseconds ` +
    "from the key to the end of the frame that shows the first draft, the exact answer and the answer of three looks for the new place. The draw calls are left out, as if a graphics card took them at once. Medians, by the clock.";
  return { title: "Following the camera", note, rows };
}

async function follow(browser: Browser, cloud: string, address: string): Promise<Row> {
  const context = await newContext(browser);
  const page = await watchedPage(context, false);
  await page.goto(address);
  await ready(page);
  const points = Number(await page.locator("#status").getAttribute("data-total"));
  console.error(`${cloud}, ${points} points: following…`);
  // The first turn is not measured: it compiles code and makes objects.
  await drag(page, 1);
  await upToDate(page);
  const from = await page.evaluate(() => performance.now());
  await drag(page, SECONDS);
  const to = await page.evaluate(() => performance.now());
  await upToDate(page);
  const during = (await watchedBy(page)).answered.filter(({ at }) => at > from && at < to);
  const rate = (kind: string) => (1000 * during.filter((answer) => answer.kind === kind).length) / (to - from);
  await page.locator("#view").focus();
  for (let i = 0; i < STEPS; i++) {
    await page.waitForTimeout(REST);
    await page.keyboard.press("ArrowLeft");
    await upToDate(page);
  }
  await page.waitForTimeout(REST);
  const { keys, answered } = await watchedBy(page);
  await context.close();
  /** The median time from a key to the first answer of this kind before the next key. */
  const after = (kind: string) =>
    median(
      keys.flatMap((key, i) => {
        const next = keys[i + 1] ?? Infinity;
        const first = answered.find((answer) => answer.kind === kind && answer.at > key && answer.at < next);
        return first === undefined ? [] : [first.shown - key];
      }),
    );
  return {
    cloud,
    points,
    "drafts/s": rate("draft"),
    "exact/s": rate("operator"),
    "draft ms": after("draft"),
    "exact ms": after("operator"),
    "three looks ms": after("looks"),
  };
}
