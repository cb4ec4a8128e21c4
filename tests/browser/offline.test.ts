import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import type { BrowserContext, Page } from "playwright-core";
import { afterEach, beforeEach, expect, test } from "vitest";
import { root } from "../root.js";
import { asciiPly, ball } from "./clouds.js";
import { servePage, type Site } from "./site.js";
import { answered, browser, reached, status } from "./support.js";

const DIST = join(root, "www", "dist");
let extra: Map<string, Buffer>;
let site: Site;
let context: BrowserContext;

beforeEach(async () => {
  extra = new Map();
  site = await servePage(extra);
  context = await browser.newContext({ viewport: { width: 1000, height: 700 } });
});

afterEach(async () => {
  await context.close();
  site.vanish();
});

/** Opens the page and waits until its cloud is there. */
async function visit(query = "?sample=bunny"): Promise<Page> {
  const page = await context.newPage();
  await page.goto(site.address + query);
  await reached(page, "ready");
  return page;
}

/** Waits until the page is kept, and its sample. */
async function kept(page: Page): Promise<void> {
  await page.evaluate(() => navigator.serviceWorker.ready);
  await page.waitForFunction(() => caches.match("samples/bunny.bin").then((found) => found !== undefined));
}

/** Whatever is stored for this site, by its name in the page's folder. */
async function stored(page: Page): Promise<Record<string, string[]>> {
  const stores = await page.evaluate(async () => {
    const names = await caches.keys();
    return Promise.all(
      names.map(async (name) => [name, (await (await caches.open(name)).keys()).map(({ url }) => url)] as const),
    );
  });
  return Object.fromEntries(
    stores.map(([name, addresses]) => [
      name.split(" ").at(-1)!,
      addresses.map((address) => address.replace(site.address, "")),
    ]),
  );
}

function dist(name: string): string {
  return readFileSync(join(DIST, name), "utf8");
}

test("after the first load the page works without a network; what is not kept is said plainly", async () => {
  const page = await visit();
  await kept(page);
  const { visible, total } = await status(page);
  site.vanish();

  await page.reload();
  expect(await reached(page, "ready")).toMatchObject({ visible, total });
  const [before] = [await status(page)];
  await page.locator("#view").press("ArrowLeft");
  await answered(page, before);

  await page.locator("#sample").selectOption("dragon_res4");
  expect((await reached(page, "error")).sentence).toBe(
    "Stanford dragon, 5k could not be downloaded: there is no connection, and it has not been opened on this device before.",
  );
  expect((await status(page)).total).toBe(total);

  // Samples that are made here, and files of this device in a format whose reader had not been needed yet.
  await page.locator("#sample").selectOption("rings");
  await page.locator('#status[data-state="ready"]').waitFor({ state: "attached" });
  const rings = (await status(page)).total;
  expect(rings).not.toBe(total);
  await page.locator("#file").setInputFiles(join(import.meta.dirname, "fixtures/ball-12.laz"));
  await page.waitForFunction((before) => Number(document.getElementById("status")!.dataset["total"]) !== before, rings);
  expect((await status(page)).state).toBe("ready");
});

test("kept are the page's own files and samples that were opened, and no file of the user's", async () => {
  extra.set("clouds/own.ply", Buffer.from(asciiPly(ball(50))));
  const page = await visit();
  await kept(page);
  await page.goto(`${site.address}?src=clouds/own.ply`);
  await reached(page, "ready");
  await page
    .locator("#file")
    .setInputFiles({ name: "mine.ply", mimeType: "", buffer: Buffer.from(asciiPly(ball(60))) });
  await page.locator('#status[data-total="60"]').waitFor({ state: "attached" });

  const { samples, ...stores } = await stored(page);
  expect(samples).toEqual(["samples/bunny.bin"]);
  expect(Object.keys(stores)).toHaveLength(1);
  const own = Object.values(stores)[0]!;
  expect(own).toContain("");
  for (const name of own)
    expect(name === "" || /^(assets|thumbnails)\/[\w.-]+$|^icon\.svg$|^page\.webmanifest$/.test(name), name).toBe(true);
  // Nothing of it was asked for before the cloud was there.
  const first = site.asked.indexOf("service-worker.js");
  expect(first).toBeGreaterThan(site.asked.indexOf("samples/bunny.bin"));
});

test("a newer build wins at the next load, and is never mixed with the one before", async () => {
  const old = await visit();
  await kept(old);
  // Another build of the page: all its scripts have other names, and name one another by these.
  const scripts = readdirSync(join(DIST, "assets")).filter((name) => name.endsWith(".js"));
  const names = new RegExp(scripts.map((name) => name.replaceAll(".", "\\.")).join("|"), "g");
  const renamed = (name: string) => dist(name).replaceAll(names, (script) => `newer-${script}`);
  for (const name of scripts) extra.set(`assets/newer-${name}`, Buffer.from(renamed(`assets/${name}`)));
  const page = renamed("index.html");
  const entry = /assets\/newer-index-[\w-]+\.js/.exec(page)![0];
  extra.set("index.html", Buffer.from(page));
  extra.set(entry, Buffer.from(`${extra.get(entry)!.toString()}\ndocument.documentElement.dataset.build = "newer";`));
  const version = /"version":\s*"(\w+)"/.exec(dist("service-worker.js"))![1]!;
  extra.set("service-worker.js", Buffer.from(renamed("service-worker.js").replaceAll(version, "newer")));
  const build = (tab: Page) => tab.evaluate(() => document.documentElement.dataset["build"] ?? "old");

  await old.reload();
  await reached(old, "ready");
  expect(await build(old)).toBe("newer");
  // The new one waits, complete, until no page of the old one is open.
  await old.evaluate(() => navigator.serviceWorker.getRegistration().then((registration) => registration!.update()));
  await old.waitForFunction(() =>
    navigator.serviceWorker.getRegistration().then((registration) => registration!.waiting !== null),
  );
  expect(Object.keys(await stored(old)).sort()).toEqual([version, "newer", "samples"].sort());
  await old.close();

  // A tab is gone a moment after it was closed; one that is opened before that belongs to the old worker, and keeps it.
  let next = await visit();
  const takenOver = async () =>
    Object.keys(await stored(next))
      .sort()
      .join() === "newer,samples";
  for (let visits = 1; visits < 10 && !(await takenOver()); visits++) {
    await next.close();
    await new Promise((resolve) => setTimeout(resolve, 500));
    next = await visit();
  }
  expect(await takenOver()).toBe(true);
  site.vanish();
  await next.reload();
  await reached(next, "ready");
  expect(await build(next)).toBe("newer");
});
