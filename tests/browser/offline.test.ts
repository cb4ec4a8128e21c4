import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import type { BrowserContext, Page } from "playwright-core";
import { afterEach, beforeEach, expect, test } from "vitest";
import { root } from "../root.js";
import { newContext } from "./browser.js";
import { asciiPly, ball } from "./clouds.js";
import { servePage, type Site } from "./site.js";
import { answered, reached, status, upToDate } from "./support.js";

const DIST = join(root, "www", "dist");
let extra: Map<string, Buffer>;
let site: Site;
let context: BrowserContext;

beforeEach(async () => {
  extra = new Map();
  site = await servePage(extra);
  context = await newContext({ viewport: { width: 1000, height: 700 }, deviceScaleFactor: 0.5 });
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

/** Waits until the page and its sample are stored for offline use. */
async function kept(page: Page): Promise<void> {
  await page.evaluate(() => navigator.serviceWorker.ready);
  await page.waitForFunction(() => caches.match("samples/bunny.bin").then((found) => found !== undefined));
}

/** All files that are stored for this site, by their names in the page's folder. */
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

test("after the first load the page works without a network; a message names files that are not stored", async () => {
  const page = await visit();
  await kept(page);
  // "ready" is reached by the first answer, which the looks replace.
  const { visible, total } = await upToDate(page);
  site.vanish();

  await page.reload();
  await reached(page, "ready");
  const before = await upToDate(page);
  expect(before).toMatchObject({ visible, total });
  await page.locator("#view").press("ArrowLeft");
  await answered(page, before);

  await page.getByRole("button", { name: "Tools" }).click();
  await page.locator("#sample").selectOption("dragon_res4");
  expect((await reached(page, "error")).sentence).toBe(
    "Stanford dragon, 5k could not be downloaded: there is no connection, and it has not been opened on this device before.",
  );
  expect((await status(page)).total).toBe(total);

  // Generated samples work. So do local files in a format whose reader was not needed before.
  await page.locator("#sample").selectOption("rings");
  await page.locator('#status[data-state="ready"]').waitFor({ state: "attached" });
  const rings = (await status(page)).total;
  expect(rings).not.toBe(total);
  await page.locator("#file").setInputFiles(join(import.meta.dirname, "fixtures/ball-12.laz"));
  await page.waitForFunction((before) => Number(document.getElementById("status")!.dataset["total"]) !== before, rings);
  expect((await status(page)).state).toBe("ready");
});

test("the page's own files and opened samples are stored, and no file of the user", async () => {
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
  for (const name of own) {
    expect(name === "" || /^(assets|thumbnails)\/[\w.-]+$|^icon\.svg$|^page\.webmanifest$/.test(name), name).toBe(true);
  }
  // Nothing was requested for storing before the cloud was shown.
  const first = site.asked.indexOf("service-worker.js");
  expect(first).toBeGreaterThan(site.asked.indexOf("samples/bunny.bin"));
});

test("a newer build is used at the next load, and is never mixed with the old build", async () => {
  const old = await visit();
  await kept(old);
  // Another build of the page: all its scripts have new names, and import one another by these names.
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
  // The new build is complete, and waits until no page of the old build is open.
  await old.evaluate(() => navigator.serviceWorker.getRegistration().then((registration) => registration!.update()));
  await old.waitForFunction(() =>
    navigator.serviceWorker.getRegistration().then((registration) => registration!.waiting !== null),
  );
  expect(Object.keys(await stored(old)).sort()).toEqual([version, "newer", "samples"].sort());

  // A closed tab ends a moment later. A tab that opens before that belongs to the old worker, and keeps it alive.
  const devtools = await context.newCDPSession(await context.newPage());
  const takenOver = new Promise<void>((resolve) => {
    devtools.on("ServiceWorker.workerVersionUpdated", ({ versions }) => {
      if (versions.some(({ status }) => status === "redundant")) resolve();
    });
  });
  await devtools.send("ServiceWorker.enable");
  await old.close();
  await takenOver;
  const next = await visit();
  await expect.poll(async () => Object.keys(await stored(next)).sort()).toEqual(["newer", "samples"]);
  site.vanish();
  await next.reload();
  await reached(next, "ready");
  expect(await build(next)).toBe("newer");
});
