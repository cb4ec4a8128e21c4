import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { georeferencedBall, rows } from "./clouds.js";
import { drop } from "./files.js";
import { colorOf, inMillimeters } from "./formats.js";
import { drag, inNode, openReady, refiltered, said, served, site, type Status, status, upToDate } from "./support.js";

// Three levels with 500, 500 and 2000 points. With this limit, the overview has the first two of them.
const LIMIT = "stream=1100";
const octree = inMillimeters(georeferencedBall(3000));
const content = new Uint8Array(readFileSync(join(import.meta.dirname, "fixtures", "octree.copc.laz")));

/** Expects the exact answer of the whole octree, asked with the inversion that the page reports. */
async function expectExact(page: Page, now: Status): Promise<void> {
  expect(now).toMatchObject({ state: "ready", answer: "operator", busy: 0, total: 3000 });
  const [, scale] = /^exponential:(.+)$/.exec(now.inversion)!;
  const inversion = { exponential: Number(scale) };
  const whole = await inNode(octree, (cloud) => cloud.visibleFrom(now.viewpoint, { inversion }));
  expect(now.visible).toBe(whole.count);
  expect(now.visible).toBeGreaterThan(500);
  expect(await said(page)).toMatch(
    /of 3,000 points can be seen from here, exactly: \d+ nodes with [\d,]+ points were read, \d+ more/,
  );
}

test("an octree beyond the limit is streamed, and its last answer is exact, also after the camera has moved", async () => {
  served.set("ranged/octree.copc.laz", content);
  const page = await openReady(`?src=ranged/octree.copc.laz&${LIMIT}`);
  const first = await status(page);
  await expectExact(page, first);
  expect(await page.locator("#message p").textContent()).toContain("3,000 points are read as they are needed");

  const asked = site.asked.length;
  await drag(page, 160, 40);
  const moved = await refiltered(page, first);
  expect(moved.viewpoint).not.toEqual(first.viewpoint);
  await expectExact(page, moved);
  // Nodes that were read before are kept. Their file is not asked again, except for nodes that were hidden.
  expect(site.asked.slice(asked).filter((name) => name.endsWith(".laz")).length).toBeLessThan(5);
});

test("a dropped octree is streamed from the file", async () => {
  const page = await openReady(`?sample=bunny&${LIMIT}`);
  const before = await status(page);
  await drop(page, "octree.copc.laz", content);
  await page
    .locator('#status[data-total="3000"][data-answer="operator"][data-busy="0"]')
    .waitFor({ state: "attached" });
  const now = await upToDate(page);
  expect(now.refilters).toBeGreaterThan(before.refilters);
  await expectExact(page, now);

  // Another cloud takes its place.
  await page.locator("#sample").selectOption("bunny");
  await page.locator('#status[data-total="1839"][data-busy="0"]').waitFor({ state: "attached" });
  expect(await status(page)).toMatchObject({ state: "ready", answer: "looks" });
});

test("a radius in the octree's units is taken, and c counts in its spacings", async () => {
  served.set("ranged/octree.copc.laz", content);
  const now = await status(await openReady(`?src=ranged/octree.copc.laz&${LIMIT}&radius=100000`));
  const whole = await inNode(octree, (cloud) => cloud.visibleFrom(now.viewpoint, { radius: 100_000 }));
  expect(now).toMatchObject({ answer: "operator", inversion: "spherical", radius: 100_000, visible: whole.count });
  const scaled = await openReady(`?src=ranged/octree.copc.laz&${LIMIT}&inversion=exponential:0.1`);
  await expectExact(scaled, await status(scaled));
});

test("settings that need all points are answered by the coarser levels alone, and the page says so", async () => {
  served.set("ranged/octree.copc.laz", content);
  const page = await openReady(`?src=ranged/octree.copc.laz&${LIMIT}&exponent=2`);
  const now = await status(page);
  expect(now).toMatchObject({ state: "ready", answer: "part", total: 3000 });
  expect(await said(page)).toContain("of the 1,000 points of the coarser levels can be seen from here");
  expect(await page.locator("#message p").textContent()).toContain("the coarser levels alone");
});

test("with too little room for its points, a view ends with a part, and says how many nodes are undecided", async () => {
  served.set("ranged/octree.copc.laz", content);
  const page = await openReady(`?src=ranged/octree.copc.laz&${LIMIT}&points=600`);
  const now = await status(page);
  expect(now).toMatchObject({ state: "ready", answer: "part", busy: 0, total: 3000 });
  expect(await said(page)).toMatch(/not exact, [1-9]\d* nodes? undecided/);
  expect(now.visible).toBeLessThanOrEqual(600);
});

test("a point of a streamed octree can be picked, with its own coordinates and color", async () => {
  served.set("ranged/octree.copc.laz", content);
  const page = await openReady(`?src=ranged/octree.copc.laz&${LIMIT}&size=8`);
  await page.locator("#tool-pick").click();
  const box = (await page.locator("#view").boundingBox())!;
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  const result = page.locator("#pick-result");
  await expect.poll(() => result.textContent()).toMatch(/512[,.]?\d{3}/);
  const place = (await result.getAttribute("data-place"))!.split(", ").map(Number);
  const index = rows(octree).findIndex((point) => point.every((value, axis) => Math.abs(value - place[axis]!) < 6e-4));
  expect(await result.textContent()).toContain(`color ${colorOf(index).join(" ")}`);
  // Coordinates and colors are read. The other columns of the file are not.
  expect(await page.locator("#color option").allTextContents()).not.toContain("intensity");
});
