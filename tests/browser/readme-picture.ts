/*
 * Makes docs/before-after.png, the picture in the README, from the built page. Run in the project's folder after
 * `npm run build`:
 *
 *   node -e "import('vite').then(({ runnerImport }) => runnerImport('tests/browser/readme-picture.ts'))"
 */
import { mkdirSync, writeFileSync } from "node:fs";
import type { Page } from "playwright-core";
import { launchBrowser, servePage } from "./site.js";

const WIDTH = 560;
const HEIGHT = 420;
const PANEL = 320;

const site = await servePage();
const browser = await launchBrowser();
const page = await browser.newPage({ viewport: { width: WIDTH + PANEL, height: HEIGHT } });
await page.goto(site.address);
await page.locator('#status[data-state="ready"]').waitFor();
// A little closer than the page begins.
for (let step = 0; step < 2; step++) await page.locator("#view").press("+");
await page.locator("#view").blur();
// The answer for the last step.
await page.waitForTimeout(2000);

const pictures: string[] = [];
for (const hidden of ["Shown", "Off"]) {
  await page.getByRole("radio", { name: hidden }).check();
  pictures.push((await page.locator("#view").screenshot()).toString("base64"));
}
const file = new URL("../../docs/before-after.png", import.meta.url);
mkdirSync(new URL(".", file), { recursive: true });
writeFileSync(file, Buffer.from(await sideBySide(page, pictures), "base64"));
await browser.close();
site.close();

function sideBySide(canvasPage: Page, images: string[]): Promise<string> {
  return canvasPage.evaluate(async (sources) => {
    const bitmaps = await Promise.all(
      sources.map(async (source) => createImageBitmap(await (await fetch(`data:image/png;base64,${source}`)).blob())),
    );
    const canvas = document.createElement("canvas");
    canvas.width = bitmaps.reduce((sum, bitmap) => sum + bitmap.width, 0);
    canvas.height = bitmaps[0]!.height;
    const context = canvas.getContext("2d")!;
    let x = 0;
    for (const bitmap of bitmaps) {
      context.drawImage(bitmap, x, 0);
      x += bitmap.width;
    }
    return canvas.toDataURL("image/png").split(",")[1]!;
  }, images);
}
