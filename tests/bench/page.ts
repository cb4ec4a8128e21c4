// The built page while the mouse turns a cloud: what its own thread does in an orbit.
import type { Browser, Page } from "playwright-core";

import { launchBrowser, servePage } from "../browser/site.js";
import { median, quantile, type Row, type Table } from "./report.js";
import { traced } from "./trace.js";

const SECONDS = 8;
const SIZE = { width: 1280, height: 800 };
const LONGEST_WAIT = 120_000;
const PICTURES = {
  "visible points": "?sample=dragon",
  "hidden points dimmed": "?sample=dragon&hidden=dimmed",
  "compared with all": "?sample=dragon&compare=0.5",
  surface: "?sample=dragon&show=surface",
  "lit by one light": "?sample=dragon&light=0.1,0.3,0.2",
  "searched radius": "?sample=dragon&radius=search",
};

export async function timePage(): Promise<Table> {
  const site = await servePage();
  const browser = await launchBrowser();
  const rows: Row[] = [];
  try {
    for (const [picture, query] of Object.entries(PICTURES)) {
      console.error(`dragon, ${picture}: orbiting…`);
      rows.push({ picture, ...(await orbit(browser, site.address + query)) });
    }
  } finally {
    await browser.close();
    site.close();
  }
  const note =
    `The mouse turns the dragon (437,645 points) for ${SECONDS} seconds. Every frame asks for its viewpoint. Milliseconds of CPU time of the page's main thread, by the browser's trace: of JavaScript (with garbage collection) ` +
    "from one frame to the next, of JavaScript in one task, and of the longest task of any kind. The draw calls are left out, as if a graphics card took them at once.";
  return { title: "The page's thread in an orbit", note, rows };
}

async function orbit(browser: Browser, address: string): Promise<Row> {
  const page = await browser.newPage({ viewport: SIZE });
  await page.addInitScript(() => {
    WebGL2RenderingContext.prototype.drawElements = WebGL2RenderingContext.prototype.drawArrays = () => undefined;
  });
  await page.goto(address);
  await status(page, '[data-state="ready"]');
  // The first turn is not measured: it compiles code and makes objects.
  await drag(page, 1);
  const { tasks, frames } = await traced(browser, page, () => drag(page, SECONDS));
  await page.close();
  const scripting = perFrame(tasks, frames);
  const longest = tasks.reduce((a, b) => (a.cpu > b.cpu ? a : b));
  return {
    frames: frames.length,
    "script median": median(scripting),
    "script p95": quantile(scripting, 0.95),
    "longest script": Math.max(...tasks.map(({ script }) => script)),
    "longest task": longest.cpu,
    "longest was": longest.what,
  };
}

/** Drags around the middle of the picture without a pause, then waits for the last answer. */
async function drag(page: Page, seconds: number): Promise<void> {
  const box = (await page.locator("#view").boundingBox())!;
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  const end = performance.now() + 1000 * seconds;
  for (let i = 0; performance.now() < end; i++) {
    await page.mouse.move(x + 200 * Math.sin(i / 30), y + 40 * Math.sin(i / 47));
  }
  await page.mouse.up();
  await status(page, '[data-busy="0"]');
}

function status(page: Page, state: string): Promise<void> {
  return page.locator(`#status${state}`).waitFor({ state: "attached", timeout: LONGEST_WAIT });
}

/** The JavaScript time from the beginning of each frame to the beginning of the next frame. */
function perFrame(tasks: { start: number; script: number }[], frames: number[]): number[] {
  const sums = frames.map(() => 0);
  let frame = -1;
  for (const { start, script } of tasks) {
    // A frame begins within its task.
    while (frame + 1 < frames.length && frames[frame + 1]! < start) frame++;
    if (frame >= 0) sums[frame]! += script;
  }
  return sums;
}
