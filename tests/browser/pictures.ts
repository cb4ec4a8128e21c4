/*
 * Makes the pictures of the page in docs from the built page. Run in the project's folder after `npm run build`:
 *
 *   node -e "import('vite').then(({ runnerImport }) => runnerImport('tests/browser/pictures.ts'))"
 */
import { join } from "node:path";
import type { BrowserContextOptions, Page } from "playwright-core";
import sharp from "sharp";
import { root } from "../root.js";
import { hideControls, launchBrowser, servePage } from "./site.js";

const site = await servePage();
const browser = await launchBrowser();

/** Opens the page in the dark theme, and takes a picture when `act` is done and nothing is under way. */
async function shot(
  query: string,
  options: BrowserContextOptions,
  act: (page: Page) => Promise<void>,
  prepare?: (page: Page) => Promise<void>,
): Promise<Buffer> {
  const page = await browser.newPage({ colorScheme: "dark", reducedMotion: "reduce", ...options });
  await prepare?.(page);
  await page.goto(site.address + query);
  const final = async () => {
    await page.locator('#status[data-state="ready"][data-busy="0"]').waitFor({ state: "attached", timeout: 120_000 });
    // The sentence about an answer comes up to 0.8 s later.
    await page.waitForTimeout(1500);
  };
  await final();
  await act(page);
  await final();
  const image = await page.screenshot();
  await page.context().close();
  return image;
}

const file = (name: string) => join(root, "docs", name);
const nothing = () => Promise.resolve();

/** The picture of the README: few and small points, so that the back shines through the front, and visible points. */
const SIZE = { width: 470, height: 384 };
const halves = await Promise.all(
  ["compare=1", "compare=0"].map((look) =>
    shot(`?sample=dragon_res3&fov=42&${look}`, { viewport: SIZE }, nothing, hideControls),
  ),
);
const words = ["all points", "visible from here"].map(
  (text, i) => `<text x="${(i + 0.5) * SIZE.width}" y="32">${text}</text>`,
);
const style = 'font-family="sans-serif" font-size="19" font-weight="600" text-anchor="middle"';
const over = `<svg xmlns="http://www.w3.org/2000/svg" width="${2 * SIZE.width}" height="${SIZE.height}" fill="#e8eaed"
  ${style}>${words.join("")}<path d="M${SIZE.width} 0v${SIZE.height}" stroke="#343a43" stroke-width="2"/></svg>`;
await sharp({ create: { width: 2 * SIZE.width, height: SIZE.height, channels: 3, background: "#14161a" } })
  .composite([
    ...halves.map((input: Buffer, i: number) => ({ input, left: i * SIZE.width, top: 0 })),
    { input: Buffer.from(over) },
  ])
  .png({ palette: true, colors: 32, dither: 0 })
  .toFile(file("before-after.png"));

const press =
  (name: string, times = 1) =>
  async (page: Page) => {
    for (let i = 0; i < times; i++) await page.getByRole("button", { name }).click();
  };
for (const [name, query, act] of [
  ["page", "", nothing],
  ["freeze", "?turn=0", press("Freeze and walk around")],
  ["measure", "?story=measure", press("Next", 2)],
  ["label", "?story=label", press("Next")],
  ["survey", "?story=survey", press("Next")],
  [
    "right",
    "?turn=0",
    async (page: Page) => {
      await press("How right is it?")(page);
      await page.locator("#right canvas").first().waitFor({ timeout: 120_000 });
    },
  ],
] as const) {
  const image = await shot(query, { viewport: { width: 1000, height: 640 } }, act);
  await sharp(image)
    .webp({ quality: 82 })
    .toFile(file(`${name}.webp`));
}
await browser.close();
site.close();
