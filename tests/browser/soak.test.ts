/*
 * The page's memory. `npm test` runs a short form, which notices if an answer's arrays, an element, a listener, a worker
 * or a WebGL object stays. HPR_SOAK=1 runs the long form, which also notices smaller growth.
 */
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { countHoldings, type Holdings, holdingsOf, type MemoryUse, memoryOf } from "./holdings.js";
import { openReady, settled, status, upToDate, unfold } from "./support.js";

const IS_LONG = process.env["HPR_SOAK"] === "1";
/** How often everything is done before the memory is measured for the first time, and how often afterwards. */
const { rounds, steps, clouds } = IS_LONG ? { rounds: 2, steps: 30, clouds: 3 } : { rounds: 2, steps: 20, clouds: 2 };

/** Allowed growth, for compiled code, and a map or an answer that is there at one time only. If each answer left its arrays in memory, the growth would be larger. */
const NOISE = { heap: 600_000, buffers: 120_000 };

/** The page's memory and objects after its timers have run. */
async function held(page: Page): Promise<MemoryUse & Holdings> {
  await settled(page);
  // The page's own timers are shorter.
  await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 1050)));
  return { ...(await memoryOf(page)), ...(await holdingsOf(page)) };
}

function expectNoMore(after: MemoryUse & Holdings, before: MemoryUse & Holdings): void {
  const { nodes, listeners, workers, objectUrls, webgl } = before;
  expect.soft(after).toMatchObject({ workers, objectUrls });
  // The program of the hidden points is there or not, as the last answer was a map or not.
  const own = { Program: 1, VertexArray: 1 } as Record<string, number>;
  for (const [name, count] of Object.entries(after.webgl)) {
    expect.soft(count, name).toBeLessThanOrEqual(webgl[name]! + (own[name] ?? 0));
  }
  expect.soft(after.nodes).toBeLessThanOrEqual(nodes);
  expect.soft(after.listeners).toBeLessThanOrEqual(listeners);
  expect.soft(after.heap - before.heap).toBeLessThan(NOISE.heap);
  expect.soft(after.buffers - before.buffers).toBeLessThan(NOISE.buffers);
}

async function step(page: Page, key: string): Promise<void> {
  const { refilters } = await status(page);
  await page.locator("#view").press(key);
  await page.waitForFunction(
    (before) => Number(document.getElementById("status")!.dataset["refilters"]) > before,
    refilters,
  );
  // The short form does not wait for looks at each place.
  if (IS_LONG) await upToDate(page);
}

async function change(page: Page, sample: string, total: number): Promise<void> {
  await page.selectOption("#sample", sample);
  await page.locator(`#status[data-state="ready"][data-total="${total}"]`).waitFor({ state: "attached" });
  await page.locator("#progress").waitFor({ state: "hidden" });
}

/** Presses a control, even in a folded section. */
async function press(page: Page, selector: string): Promise<void> {
  await page
    .locator(selector)
    .first()
    .evaluate((element: HTMLElement) => {
      element.click();
    });
  await upToDate(page);
}

/** Switches modes on and off again. */
async function around(page: Page): Promise<void> {
  for (const mode of ["dimmed", "shown", "off"]) await press(page, `#hidden-points [value="${mode}"]`);
  await unfold(page, "Look");
  for (const color of ["height", "own"]) await page.selectOption("#color", color);
  for (const frozen of [true, false]) await press(page, `#walk[aria-pressed="${!frozen}"]`);
  for (const compared of [true, false]) await press(page, `#tool-compare[aria-pressed="${!compared}"]`);
  await press(page, "#tool-measure");
  for (const end of ["first", "second"]) {
    await page.locator("#view").click({ position: { x: end === "first" ? 300 : 320, y: 120 } });
  }
  await press(page, "#measure-clear");
  await press(page, "#tool-measure");
}

test(`the page's memory does not grow with answers, clouds or modes (${IS_LONG ? "long" : "short"})`, async () => {
  // A small window, because software draws it.
  const page = await openReady("?sample=dragon_res4", { viewport: { width: 770, height: 420 } }, countHoldings);
  const move = async (count: number) => {
    for (let i = 0; i < count; i++) await step(page, "ArrowLeft");
  };
  const exchange = async () => {
    await change(page, "bunny", 1839);
    await change(page, "dragon_res4", 5205);
  };
  // The page makes some things at the first use of a mode, and some after the first steps of a cloud, to fade between
  // two answers.
  for (let round = 0; round < rounds; round++) {
    await around(page);
    await exchange();
    await move(10);
  }
  const first = await held(page);

  await move(steps);
  expectNoMore(await held(page), first);

  await around(page);
  for (let i = 0; i < clouds; i++) await exchange();
  await move(10);
  expectNoMore(await held(page), first);
});
