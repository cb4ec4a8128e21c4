/*
 * Makes docs/orbit.png: how the page draws a million points while the camera moves. Run in the project's folder after
 * `npm run build`:
 *
 *   node -e "import('vite').then(({ runnerImport }) => runnerImport('tests/browser/orbit-picture.ts'))"
 *
 * The camera has turned by 30° since the last answer. To the left: the points of that answer alone, which is what the
 * page showed before it had drafts. The points that the camera has just come to see are missing, like a shadow. In the
 * middle: what it draws until the first draft for the new place. To the right: the final answer.
 */
import { writeFileSync } from "node:fs";
import type { Page } from "playwright-core";
import { fourBalls } from "./balls.js";
import { hold, holdable, release } from "./held.js";
import { addStyle, launchBrowser, servePage } from "./site.js";

const SIZE = { width: 300, height: 260 };
const FINAL = '#status[data-state="ready"][data-busy="0"]';
/** Each press of an arrow key turns the camera by 5°. */
const PRESSES = 6;

const site = await servePage(new Map([["balls.ply", fourBalls(1_000_000)]]));
const browser = await launchBrowser();
const context = await browser.newContext({ viewport: SIZE, reducedMotion: "reduce" });
const page = await context.newPage();
await holdable(page);
const first = `${site.address}?src=balls.ply&up=y&embed=1&theme=light&color=plain`;
await open(`${first}&view=0,1,8.5`);
await hold(page);
for (let i = 0; i < PRESSES; i++) await page.locator("#view").press("ArrowLeft");
await page.locator("#view").blur();
const during = await shoot();
await release(page);
await page.locator('#status[data-busy="1"]').waitFor({ state: "attached" });
await page.locator(FINAL).waitFor({ state: "attached", timeout: 120_000 });
const after = await shoot();
await page.waitForFunction(() => location.search.includes("target") || !location.search.includes("view=0,1,8.5"));
const view = new URL(page.url()).searchParams.get("view")!;
await open(`${first}&view=${view}&freeze=0,1,8.5`);
const before = await shoot();
writeFileSync(
  new URL("../../docs/orbit.png", import.meta.url),
  Buffer.from(await strip(page, [before, during, after]), "base64"),
);
await browser.close();
site.close();

async function open(address: string): Promise<void> {
  await page.goto(address);
  await page.locator(FINAL).waitFor({ state: "attached", timeout: 120_000 });
  await addStyle(page, "#signs, #whole-page { display: none }");
}

async function shoot(): Promise<string> {
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
  return (await page.locator("#view").screenshot({ timeout: 120_000 })).toString("base64");
}

function strip(canvasPage: Page, images: string[]): Promise<string> {
  return canvasPage.evaluate(async (sources) => {
    const bitmaps = await Promise.all(
      sources.map(async (source) => createImageBitmap(await (await fetch(`data:image/png;base64,${source}`)).blob())),
    );
    const [{ width, height }] = bitmaps as [ImageBitmap];
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [sources.length * width, height];
    const drawing = canvas.getContext("2d")!;
    bitmaps.forEach((bitmap, i) => {
      drawing.drawImage(bitmap, i * width, 0);
    });
    return canvas.toDataURL("image/png").split(",")[1]!;
  }, images);
}
