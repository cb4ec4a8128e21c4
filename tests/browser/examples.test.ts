// The examples that are pages, as they are hosted beside the demo page. Each draws its picture in the gallery. After a
// change of an example, HPR_PICTURES=write makes the pictures again.
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import type { Page } from "playwright-core";
import sharp from "sharp";
import { afterAll, beforeAll, expect, it } from "vitest";

import { root } from "../root.js";
import { newPage } from "./browser.js";
import { servePage, type Site } from "./site.js";

const folder = join(root, "examples");
const names = readdirSync(folder)
  .filter((name) => name.endsWith(".html") && name !== "index.html")
  .map((name) => name.slice(0, -".html".length));
const viewport = { width: 640, height: 400 };

let site: Site;
beforeAll(async () => {
  site = await servePage();
});
afterAll(() => {
  site.close();
});

/** What a visitor does before the picture is taken, and what the page then says. */
const acts: Record<string, (page: Page, picture: string) => Promise<void>> = {
  async measure(page, picture) {
    // The two edges of the door, in whose opening the room can be seen.
    await settled(page, picture);
    await page.mouse.click(120, 200);
    await page.mouse.click(520, 200);
    const meters = Number.parseFloat(await page.locator("output").innerText());
    // Both points are on the wall before the room, 2.9 m away, and not on the room's back wall.
    expect(meters).toBeGreaterThan(2);
    expect(meters).toBeLessThan(6);
  },
  async labels(page) {
    await expect.poll(() => page.locator("span:visible").allInnerTexts()).not.toContain("sofa");
    expect(await page.locator("span:visible").allInnerTexts()).toContain("wall");
  },
  async lasso(page, picture) {
    await settled(page, picture);
    await page.mouse.move(80, 120);
    await page.mouse.down();
    for (const [x, y] of [[200, 120], [200, 280], [80, 280]] as const) await page.mouse.move(x, y, { steps: 8 }); // prettier-ignore
    await page.mouse.up();
    const [, count] = /Save (\d+) points/.exec(await page.locator("button").innerText())!;
    expect(Number(count)).toBeGreaterThan(500);
    const saved = page.waitForEvent("download");
    await page.getByRole("button").click();
    const file = readFileSync(await (await saved).path(), "latin1");
    expect(file).toContain(`element vertex ${count}\n`);
    // All of them are on the wall: none is from the room behind it.
    expect(file.startsWith("ply\n")).toBe(true);
  },
  async plain(page) {
    await page.mouse.move(300, 250);
  },
};

const SMALL = { width: 80, height: 50 };
const shrunk = (image: Buffer | string) =>
  sharp(image).resize(SMALL.width, SMALL.height, { fit: "fill" }).removeAlpha().raw().toBuffer();

/** Small points fall on other pixels elsewhere, and the pictures are packed. */
const TOLERANCE = 8;

/** The mean difference of two pictures, from 0 to 255. */
async function apart(one: Buffer | string, other: Buffer | string): Promise<number> {
  const [a, b] = await Promise.all([shrunk(one), shrunk(other)]);
  return a.reduce((sum, value, i) => sum + Math.abs(value - b[i]!), 0) / a.length;
}

const IS_WRITING = process.env["HPR_PICTURES"] === "write";

/**
 * Three equal pictures, half a second apart. A slow machine may rest as long before the page is ready, so they must be about
 * the gallery's, or about another one.
 */
async function settled(page: Page, picture: string, isOther = false): Promise<Buffer> {
  let last: Buffer = Buffer.alloc(0);
  let equal = 0;
  const seen = async () => {
    const next = await page.screenshot();
    equal = next.equals(last) && next.length > 5000 ? equal + 1 : 0;
    last = next;
    if (equal < 3) return NaN;
    return IS_WRITING ? 0 : apart(next, picture);
  };
  const poll = expect.poll(seen, { interval: 500, timeout: 300_000 });
  await (isOther ? poll.toBeGreaterThan(TOLERANCE) : poll.toBeLessThan(TOLERANCE));
  return last;
}

it.each(names)("%s draws its picture", async (name) => {
  const page = await newPage({ viewport });
  const failures: string[] = [];
  page.on("pageerror", (error) => failures.push(String(error)));
  page.on("console", (message) => message.type() === "error" && failures.push(message.text()));
  if (name === "potree") await standIn(page);
  const picture = join(folder, "pictures", `${name}.webp`);
  await page.goto(`${site.address}examples/${name}.html`);
  await acts[name]?.(page, picture);
  const image = await settled(page, picture);
  if (IS_WRITING) writeFileSync(picture, await sharp(image).resize(480, 300).webp({ quality: 60 }).toBuffer());
  if (name === "hide") {
    await page.getByRole("checkbox").uncheck();
    // All points are another picture.
    if (!IS_WRITING) await settled(page, picture, true);
  }
  expect(failures).toEqual([]);
  await page.close();
});

/** Potree is in no package: a viewer with the parts that the filter uses stands for it. */
async function standIn(page: Page): Promise<void> {
  const viewer = readFileSync(join(root, "tests/browser/potree/viewer.js"), "utf8");
  await page.route(/\/(libs|build)\//, (route) =>
    route.fulfill({
      contentType: "text/javascript",
      body: route.request().url().endsWith("potree.js") ? `${viewer}\n${POTREE}` : "",
    }),
  );
}

const POTREE = `
globalThis.Potree = {
  Viewer: function (area) {
    const canvas = area.appendChild(Object.assign(document.createElement("canvas"), { width: 300, height: 300 }));
    const viewer = makeViewer(canvas);
    viewer.scene.addPointCloud = () => undefined;
    viewer.fitToScreen = () => requestAnimationFrame(function next() { viewer.frame(0); requestAnimationFrame(next); });
    return viewer;
  },
  loadPointCloud: () => Promise.resolve({}),
};`;

it("the gallery shows each with its source", async () => {
  const page = await newPage({ viewport: { width: 1100, height: 800 } });
  await page.goto(`${site.address}examples/index.html`);
  expect(await page.locator("article").count()).toBe(names.length);
  for (const name of names) {
    const card = page.locator("article", { has: page.locator(`a[href="${name}.html"]`) });
    expect(await card.locator("img").evaluate((image) => (image as HTMLImageElement).naturalWidth)).toBe(480);
    const source = await (await page.request.get(`${site.address}examples/source/${name}.txt`)).text();
    expect(source).toBe(readFileSync(join(folder, `${name}.html`), "utf8"));
    expect(source.trimEnd().split("\n").length, name).toBeLessThanOrEqual(80);
  }
  await page.close();
});
