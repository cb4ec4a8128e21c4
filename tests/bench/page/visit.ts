// The built page in Chromium, watched from outside.
import type { Browser, BrowserContext, Page } from "playwright-core";

import { countHoldings } from "../../browser/holdings.js";

export const SIZE = { width: 1280, height: 800 };
const LONGEST_WAIT = 120_000;

export interface Watched {
  /** The time at which the first frame with points was done, with or without an answer. */
  firstPoints?: number;
  /** The time at which the first frame with an answer was done, in milliseconds since the navigation. */
  firstPicture?: number;
  /** For each viewpoint: when it was asked, and when the page got its answer. The frame of the answer follows later. */
  asked: Record<string, number>;
  answered: Answered[];
  /** When each key was pressed. */
  keys: number[];
}

interface Answered {
  viewpoint: string;
  kind: string;
  at: number;
  /** When the frame that shows it was done. */
  shown: number;
}

type Watching = typeof globalThis & { watched: Watched };

/** A page that records its own times from the beginning. Its draw calls can be left out, if software would draw. */
export async function watchedPage(context: BrowserContext, drawing = true): Promise<Page> {
  const page = await context.newPage();
  await countHoldings(page);
  if (!drawing) {
    await page.addInitScript(() => {
      WebGL2RenderingContext.prototype.drawElements = WebGL2RenderingContext.prototype.drawArrays = () => undefined;
    });
  }
  await page.addInitScript(() => {
    const watched: Watched = { asked: {}, answered: [], keys: [] };
    (globalThis as Watching).watched = watched;
    addEventListener("keydown", ({ timeStamp }) => watched.keys.push(timeStamp), { capture: true });
    const methods = Worker.prototype as unknown as Record<string, (...args: unknown[]) => void>;
    const post = methods["postMessage"]!;
    methods["postMessage"] = function (...args: unknown[]) {
      const { content } = (args[0] ?? {}) as { content?: { kind?: string; viewpoint?: ArrayLike<number> } };
      if (content?.kind === "visibleFrom" && content.viewpoint) {
        watched.asked[Array.from(content.viewpoint).join()] ??= performance.now();
      }
      post.apply(this, args);
    };
    const draws = WebGL2RenderingContext.prototype as unknown as Record<string, (...given: number[]) => void>;
    for (const name of ["drawElements", "drawArrays"]) {
      const own = draws[name]!;
      draws[name] = function (this: unknown, ...given: number[]) {
        own.apply(this, given);
        // The shading is drawn as one triangle.
        if (watched.firstPoints !== undefined || Math.max(given[1]!, given[2]!) <= 3) return;
        watched.firstPoints = 0;
        requestAnimationFrame((now) => (watched.firstPoints = now));
      };
    }
    let refilters = "";
    new MutationObserver(() => {
      const { dataset } = document.getElementById("status") ?? {};
      if (dataset?.["refilters"] === undefined || dataset["refilters"] === refilters) return;
      refilters = dataset["refilters"];
      const { viewpoint, answer: kind } = dataset as Record<string, string>;
      const answer = { viewpoint: viewpoint!, kind: kind!, at: performance.now(), shown: Infinity };
      watched.answered.push(answer);
      // The second frame begins when the first one is done.
      requestAnimationFrame(() =>
        requestAnimationFrame((now) => {
          answer.shown = now;
          watched.firstPicture ??= now;
        }),
      );
    }).observe(document, { subtree: true, attributes: true, attributeFilter: ["data-refilters"] });
  });
  return page;
}

export function watchedBy(page: Page): Promise<Watched> {
  return page.evaluate(() => (globalThis as Watching).watched);
}

export async function ready(page: Page): Promise<void> {
  await page.locator('#status[data-state="ready"]').waitFor({ state: "attached", timeout: LONGEST_WAIT });
  await upToDate(page);
}

/** Waits until the picture shows the present settings and camera. */
export async function upToDate(page: Page): Promise<void> {
  await page.locator('#status[data-busy="0"]').waitFor({ state: "attached", timeout: LONGEST_WAIT });
}

/** Waits for the answer to a question that is asked after this call, and for all other questions. */
export async function answered(page: Page, action: () => Promise<unknown>): Promise<void> {
  const before = await page.locator("#status").getAttribute("data-refilters");
  await action();
  await page.locator(`#status:not([data-refilters="${before}"])`).waitFor({ state: "attached", timeout: LONGEST_WAIT });
  await upToDate(page);
}

/** Drags around the middle of the picture without a pause. */
export async function drag(page: Page, seconds: number): Promise<void> {
  const box = (await page.locator("#view").boundingBox())!;
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  const end = performance.now() + 1000 * seconds;
  for (let i = 0; performance.now() < end; i++) {
    await page.mouse.move(x + 200 * Math.sin(i / 30), y + 40 * Math.sin(i / 47));
  }
  await page.mouse.up();
}

export async function newContext(browser: Browser): Promise<BrowserContext> {
  return browser.newContext({ viewport: SIZE, acceptDownloads: true });
}
