/*
 * Makes the small pictures of the samples, www/public/thumbnails, from the built page. Run in the project's folder after
 * `npm run build`, then build again:
 *
 *   node -e "import('vite').then(({ runnerImport }) => runnerImport('tests/browser/thumbnails.ts'))"
 */
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import sharp from "sharp";
import { hideControls, launchBrowser, servePage } from "./site.js";

/** Twice the size on the page, for screens with two device pixels for each CSS pixel. */
const WIDTH = 168;
const HEIGHT = 112;
/** Drawn larger, and then scaled down smoothly. */
const SCALE = 4;
const SAMPLES = ["dragon_res2", "room", "street", "tile"];
const FOLDER = join(import.meta.dirname, "../../www/public/thumbnails");

mkdirSync(FOLDER, { recursive: true });
const site = await servePage();
const browser = await launchBrowser();
for (const sample of SAMPLES) {
  const page = await browser.newPage({ viewport: { width: SCALE * WIDTH, height: SCALE * HEIGHT } });
  await hideControls(page);
  await page.goto(`${site.address}?sample=${sample}&theme=dark&compare=0.5`);
  await page.locator('#status[data-state="ready"][data-busy="0"]').waitFor({ state: "attached", timeout: 120_000 });
  await page.waitForTimeout(1000);
  const picture = sharp(await page.locator("#view").screenshot()).resize(WIDTH, HEIGHT);
  const bytes = await picture.avif({ quality: 36, effort: 9 }).toBuffer();
  writeFileSync(join(FOLDER, `${sample}.avif`), bytes);
  console.log(`${sample}: ${bytes.length} bytes`);
  await page.close();
}
await browser.close();
site.close();
