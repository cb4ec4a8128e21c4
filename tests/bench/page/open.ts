// The time from the navigation to the first picture.
import type { Browser, BrowserContext } from "playwright-core";

import { median, type Row, type Table } from "../report.js";
import { newContext, ready, watchedBy, watchedPage } from "./visit.js";

const VISITS = 3;
const QUERIES = { "dragon, as the page opens": "", "dragon 23k": "?sample=dragon_res3", room: "?sample=room" };

/** The browser frees the picture of a closed page only now. Otherwise the next page would wait for that. */
const BETWEEN = 1500;

interface Visit {
  paint: number;
  points: number;
  picture: number;
}

export async function timeOpening(browser: Browser, address: string): Promise<Table> {
  const rows: Row[] = [];
  for (const [cloud, query] of Object.entries(QUERIES)) {
    console.error(`${cloud}: opening…`);
    const [cold, warm]: Visit[][] = [[], []];
    for (let i = 0; i < VISITS; i++) {
      // A new context has an empty cache. The second visit in the same context finds everything in it.
      const context = await newContext(browser);
      cold!.push(await visit(context, address + query));
      warm!.push(await visit(context, address + query));
      await context.close();
    }
    rows.push(row(cloud, "cold", cold!), row(cloud, "warm", warm!));
  }
  const note =
    `Milliseconds from the start of the navigation, served by this machine: to the first contentful paint, to the end of the first frame that shows points, and to the end of the first frame that shows an answer. Medians of ${VISITS} visits, and the slowest. ` +
    "Cold: nothing in the browser's cache; warm: the second visit.";
  return { title: "First picture", note, rows };
}

async function visit(context: BrowserContext, address: string): Promise<Visit> {
  const page = await watchedPage(context);
  await page.goto(address);
  await ready(page);
  await page.waitForFunction(
    () => ((globalThis as { watched?: { firstPicture?: number } }).watched?.firstPicture ?? 0) > 0,
  );
  const { firstPicture = NaN, firstPoints = NaN } = await watchedBy(page);
  const paint = await page.evaluate(() => performance.getEntriesByName("first-contentful-paint")[0]?.startTime ?? NaN);
  await page.close();
  await new Promise((resolve) => setTimeout(resolve, BETWEEN));
  return { paint, points: firstPoints, picture: firstPicture };
}

function row(cloud: string, cache: string, visits: Visit[]): Row {
  const pictures = visits.map(({ picture }) => picture);
  return {
    cloud,
    cache,
    "first contentful paint": median(visits.map(({ paint }) => paint)),
    "first points": median(visits.map(({ points }) => points)),
    "first picture": median(pictures),
    "slowest first picture": Math.max(...pictures),
  };
}
