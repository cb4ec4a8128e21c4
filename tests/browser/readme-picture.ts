/*
 * Makes docs/before-after.png, the picture in the README, from the built page. Run in the project's folder after
 * `npm run build`:
 *
 *   node -e "import('vite').then(({ runnerImport }) => runnerImport('tests/browser/readme-picture.ts'))"
 */
import { mkdirSync, writeFileSync } from "node:fs";
import type { Page } from "playwright-core";
import sharp from "sharp";
import { addStyle, launchBrowser, servePage } from "./site.js";

const WIDTH = 470;
const HEIGHT = 384;
const PANEL = 320;

interface Half {
  label: string;
  /** A PNG file in base64. */
  image: string;
}

const site = await servePage();
const browser = await launchBrowser();
const page = await browser.newPage({ viewport: { width: WIDTH + PANEL, height: HEIGHT } });
// Few and small points, so that the back shines through the front, as in any viewer.
await page.goto(`${site.address}?sample=dragon_res3`);
await page.locator('#status[data-state="ready"]').waitFor();
await addStyle(page, "#tools, #marks { display: none }");
// Moves a little closer than the page's first view.
for (let step = 0; step < 2; step++) await page.locator("#view").press("+");
await page.locator("#view").blur();
// Waits for the answer to the last step.
await page.waitForTimeout(2000);

await page.locator("summary", { hasText: "Look" }).click();

const halves: Half[] = [];
for (const { label, hidden, size } of [
  { label: "all points", hidden: "Highlight", size: "0.5" },
  { label: "visible from here", hidden: "Hide", size: "2" },
]) {
  await page.getByRole("radio", { name: hidden }).check();
  await page.getByLabel("Point size").fill(size);
  halves.push({ label, image: (await page.locator("#view").screenshot()).toString("base64") });
}
const file = new URL("../../docs/before-after.png", import.meta.url);
mkdirSync(new URL(".", file), { recursive: true });
const picture = sharp(Buffer.from(await sideBySide(page, halves), "base64"));
writeFileSync(file, await picture.png({ palette: true, colors: 32, dither: 0 }).toBuffer());
await browser.close();
site.close();

function sideBySide(canvasPage: Page, sources: Half[]): Promise<string> {
  return canvasPage.evaluate(async (parts) => {
    const bitmaps = await Promise.all(
      parts.map(async ({ image: source }) =>
        createImageBitmap(await (await fetch(`data:image/png;base64,${source}`)).blob()),
      ),
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
    context.font = "600 19px system-ui, sans-serif";
    context.textAlign = "center";
    context.fillStyle = "#e8eaed";
    for (const [i, { label }] of parts.entries()) context.fillText(label, (i + 0.5) * bitmaps[0]!.width, 32);
    context.fillStyle = "#343a43";
    context.fillRect(bitmaps[0]!.width - 1, 0, 2, canvas.height);
    return canvas.toDataURL("image/png").split(",")[1]!;
  }, sources);
}
