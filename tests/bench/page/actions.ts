// Other actions on the page, and how long each blocks the page's thread.
import { writeFileSync } from "node:fs";

import type { Browser, Page } from "playwright-core";

import { plyParts } from "../../../www/tools/ply.js";
import { dragon } from "../clouds.js";
import { scratch } from "../paths.js";
import type { Row, Table } from "../report.js";
import { traced } from "./trace.js";
import { answered, newContext, ready, upToDate, watchedPage } from "./visit.js";

type Action = [what: string, act: (page: Page, address: string) => Promise<unknown>];

const ACTIONS: Action[] = [
  [
    "open the page",
    async (page, address) => {
      await page.goto(address);
      await ready(page);
      // The choice of a color and the plot are in folded sections.
      for (const section of ["look", "advanced"]) await page.locator(`#${section}-section > summary`).click();
      await calm(page);
    },
  ],
  ["another cloud: room", (page) => opened(page, () => page.selectOption("#sample", "room"))],
  ["another cloud: dragon", (page) => opened(page, () => page.selectOption("#sample", "dragon"))],
  ["a file: dragon as PLY, colors, 3 attributes", (page) => opened(page, () => page.setInputFiles("#file", file))],
  ["color by height", (page) => still(page, () => page.selectOption("#color", "height"))],
  ["color by a number", (page) => still(page, () => page.selectOption("#color", "intensity"))],
  ["color by a class", (page) => still(page, () => page.selectOption("#color", "classification"))],
  ["its own colors", (page) => still(page, () => page.selectOption("#color", "own"))],
  ["hidden points dimmed", (page) => still(page, () => press(page, '[name="hidden"][value="dimmed"]'))],
  ["hidden points off", (page) => still(page, () => press(page, '[name="hidden"][value="off"]'))],
  ["compare", (page) => still(page, () => press(page, "#tool-compare"))],
  ["compare no more", (page) => still(page, () => press(page, "#tool-compare"))],
  ["up: z", (page) => answered(page, () => press(page, '[name="up"][value="z"]'))],
  ["up: y", (page) => answered(page, () => press(page, '[name="up"][value="y"]'))],
  ["surface", (page) => answered(page, () => press(page, '[name="show"][value="surface"]'))],
  ["surface, a step", (page) => answered(page, () => page.locator("#view").press("ArrowLeft"))],
  ["a light", (page) => still(page, () => press(page, "#add-light"))],
  ["no light", (page) => still(page, () => press(page, "#lights-list button"))],
  ["points", (page) => answered(page, () => press(page, '[name="show"][value="points"]'))],
  ["any of 5 viewpoints", (page) => answered(page, () => press(page, '[name="viewpoints"][value="any"]'))],
  ["one viewpoint", (page) => answered(page, () => press(page, '[name="viewpoints"][value="one"]'))],
  ["exponential flip", (page) => answered(page, () => press(page, '[name="inversion"][value="exponential"]'))],
  ["spherical flip", (page) => answered(page, () => press(page, '[name="inversion"][value="spherical"]'))],
  [
    "freeze, and a step",
    async (page) => {
      await press(page, "#freeze");
      await page.locator("#view").press("ArrowLeft");
      await calm(page);
    },
  ],
  ["unfreeze", (page) => answered(page, () => press(page, "#freeze"))],
  ["the radius plot, until its last point", plotted],
  [
    "pick a point",
    (page) =>
      still(page, async () => {
        await press(page, "#tool-pick");
        await page.locator("#view").click();
      }),
  ],
  [
    "pick one through the surface",
    (page) =>
      still(page, async () => {
        await press(page, "#through");
        await page.locator("#view").click();
      }),
  ],
  [
    "lasso around all that is seen",
    async (page) => {
      await press(page, "#through");
      await press(page, "#tool-select");
      await lasso(page);
    },
  ],
  [
    "lasso around all, through the surface",
    async (page) => {
      await press(page, "#through");
      await lasso(page);
    },
  ],
  [
    "lasso once more, added",
    async (page) => {
      await page.keyboard.down("Shift");
      await lasso(page);
      await page.keyboard.up("Shift");
    },
  ],
  [
    "lasso once more, taken away",
    async (page) => {
      await page.keyboard.down("Alt");
      await lasso(page);
      await page.keyboard.up("Alt");
    },
  ],
  ["select all in the picture", (page) => still(page, () => press(page, "#select-all"))],
  ["export as PLY", (page) => saved(page, "#export-ply")],
  ["export as JSON", (page) => saved(page, "#export-json")],
  ["export as CSV", (page) => saved(page, "#export-csv")],
  ["export the picture", (page) => saved(page, "#export-png")],
];

const file = scratch("scan.ply");

export async function timeActions(browser: Browser, address: string): Promise<Table> {
  writeFileSync(file, scan());
  const context = await newContext(browser);
  const page = await watchedPage(context);
  const rows: Row[] = [];
  for (const [action, act] of ACTIONS) {
    console.error(`${action}…`);
    const { tasks } = await traced(browser, page, async () => {
      await act(page, address);
    });
    const longest = tasks.reduce((a, b) => (a.cpu > b.cpu ? a : b));
    rows.push({
      action,
      "longest task": longest.cpu,
      "its script": longest.script,
      "its wall-clock": longest.wall,
      "tasks > 16 ms": tasks.filter(({ cpu }) => cpu > 16).length,
      "all script": tasks.reduce((sum, { script }) => sum + script, 0),
      "longest was": longest.what,
    });
  }
  await context.close();
  const note =
    "The dragon (437,645 points), unless the action names another cloud. The actions follow one another in one page. Milliseconds of CPU time of the page's main thread. For the longest task also: the JavaScript in it, and its wall-clock time, which includes waiting for the graphics process (software, here) and for a core.";
  return { title: "What blocks the page's thread", note, rows };
}

/** The dragon with the other data of a scan: colors, two numbers and a class for each point. */
function scan(): Buffer {
  const { positions } = dragon("dragon");
  const count = positions.length / 3;
  const indices = Uint32Array.from({ length: count }, (_, i) => i);
  const fields = [
    { name: "intensity", values: Uint16Array.from(indices, (i) => 30_000 + 20_000 * Math.sin(i / 1000)) },
    { name: "classification", values: Uint8Array.from(indices, (i) => 2 + (Math.floor(i / 3000) % 5)) },
    { name: "time", values: Float64Array.from(indices, (i) => 1e5 + i / 7) },
  ];
  const colors = Uint8Array.from({ length: 3 * count }, (_, i) => (i * 7) % 256);
  return Buffer.concat(
    Array.from(plyParts({ positions, colors, fields, indices, comments: [] }), (part) =>
      typeof part === "string" ? Buffer.from(part) : Buffer.from((part as DataView<ArrayBuffer>).buffer),
    ),
  );
}

/** Waits until nothing has happened for a while. The address, the sentence and the resting camera have timers. */
async function calm(page: Page): Promise<void> {
  await upToDate(page);
  await page.waitForTimeout(1000);
}

async function still(page: Page, action: () => Promise<unknown>): Promise<void> {
  await action();
  await calm(page);
}

async function opened(page: Page, action: () => Promise<unknown>): Promise<void> {
  await answered(page, action);
  await page.locator("#progress").waitFor({ state: "hidden" });
  await calm(page);
}

/** Presses a control, even in a folded section. */
async function press(page: Page, selector: string): Promise<void> {
  await page
    .locator(selector)
    .first()
    .evaluate((element: HTMLElement) => {
      element.click();
    });
}

async function plotted(page: Page): Promise<void> {
  await press(page, "#plot-section summary");
  await page.locator('#plot[data-points="13"]').waitFor({ state: "attached", timeout: 120_000 });
  await press(page, "#plot-section summary");
}

async function lasso(page: Page): Promise<void> {
  const box = (await page.locator("#view").boundingBox())!;
  const at = (turn: number) =>
    [box.x + box.width * (0.5 + 0.48 * Math.cos(turn)), box.y + box.height * (0.5 + 0.48 * Math.sin(turn))] as const;
  await page.mouse.move(...at(0));
  await page.mouse.down();
  for (let i = 1; i < 60; i++) await page.mouse.move(...at((2 * Math.PI * i) / 60));
  await page.mouse.up();
  await calm(page);
}

async function saved(page: Page, button: string): Promise<void> {
  if (!(await page.locator("#export-card").isVisible())) await press(page, "#tool-export");
  const download = page.waitForEvent("download");
  await press(page, button);
  await (await download).path();
  await calm(page);
}
