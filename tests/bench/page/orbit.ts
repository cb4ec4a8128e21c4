// The page's thread while the camera orbits and every move is a new question.
import type { Browser, Page } from "playwright-core";

import { median, quantile, type Row, type Table } from "../report.js";
import { traced } from "./trace.js";
import { answered, drag, newContext, ready, upToDate, watchedBy, watchedPage } from "./visit.js";

const SECONDS = 8;
/** The name of the first picture. Only this picture is also timed with its drawing. */
const FIRST = "visible points";
const PICTURES = {
  [FIRST]: "?sample=dragon",
  "hidden points dimmed": "?sample=dragon&hidden=dimmed",
  "compared with all": "?sample=dragon&compare=0.5",
  "colored by height": "?sample=dragon&color=height",
  surface: "?sample=dragon&show=surface",
  "lit by one light": "?sample=dragon&light=0.1,0.3,0.2",
  "at least 2 of 5 viewpoints": "?sample=dragon&viewpoints=two",
  "searched radius": "?sample=dragon&radius=search",
};

export async function timeOrbit(browser: Browser, address: string): Promise<Table[]> {
  const threads: Row[] = [];
  const answers: Row[] = [];
  for (const drawing of [false, true]) {
    for (const [picture, query] of Object.entries(PICTURES)) {
      // One picture drawn by software is enough to see the difference.
      if (drawing && picture !== FIRST) continue;
      console.error(`dragon, ${picture}: orbiting…`);
      const context = await newContext(browser);
      const page = await watchedPage(context, drawing);
      await page.goto(address + query);
      await ready(page);
      // The first turn is not measured: it compiles code and makes objects.
      await orbit(page, 1);
      const from = await page.evaluate(() => performance.now());
      const { tasks, frames } = await traced(browser, page, () => orbit(page, SECONDS));
      const to = await page.evaluate(() => performance.now());
      const scripting = perFrame(tasks, frames);
      const longest = tasks.reduce((a, b) => (a.cpu > b.cpu ? a : b));
      const label = { picture: `${picture}${drawing ? ", drawn" : ""}` };
      threads.push({
        ...label,
        frames: frames.length,
        "script median": median(scripting),
        "script p95": quantile(scripting, 0.95),
        "script most": Math.max(...scripting),
        "longest script": Math.max(...tasks.map(({ script }) => script)),
        "longest task": longest.cpu,
        "longest was": longest.what,
      });
      answers.push({
        ...label,
        "frames/s": (1000 * frames.length) / (to - from),
        ...(await answering(page, from, to)),
      });
      await context.close();
    }
  }
  return [
    {
      title: "The page's thread in an orbit",
      note:
        `The mouse turns the dragon (437,645 points) for ${SECONDS} seconds. Every frame asks for its viewpoint. Milliseconds of CPU time of the page's main thread, by the browser's trace: of JavaScript (with garbage collection) ` +
        "from one frame to the next, of JavaScript in one task, and of the longest task of any kind. The draw calls are left out, as if a graphics card took them at once. Only the last row includes them, drawn by software.",
      rows: threads,
    },
    {
      title: "Answers in an orbit",
      note:
        "In the same orbits, by the clock: frames and answers a second, and milliseconds from a question to its answer being told to the page (the frame after that shows it). Then from a single step by key " +
        "until the page has the answer for where the camera is now.",
      rows: answers,
    },
  ];
}

async function orbit(page: Page, seconds: number): Promise<void> {
  await drag(page, seconds);
  await upToDate(page);
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

async function answering(page: Page, from: number, to: number): Promise<Row> {
  const { asked, answered: told } = await watchedBy(page);
  const during = told.filter(({ at }) => at > from && at < to);
  const waits = during.flatMap(({ viewpoint, at }) => (asked[viewpoint] === undefined ? [] : [at - asked[viewpoint]]));
  const steps: number[] = [];
  await page.locator("#view").focus();
  for (let i = 0; i < 10; i++) {
    const start = performance.now();
    await answered(page, () => page.keyboard.press("ArrowLeft"));
    steps.push(performance.now() - start);
    await page.waitForTimeout(300);
  }
  return {
    "answers/s": (1000 * during.length) / (to - from),
    ...(waits.length === 0 ? {} : { "answer median": median(waits), "answer p95": quantile(waits, 0.95) }),
    "step median": median(steps),
    "step most": Math.max(...steps),
  };
}
