import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { binaryPly, georeferencedBall } from "./clouds.js";
import { drag, inNode, openReady, served, settled, status, upToDate } from "./support.js";

/*
 * The ball of 600 points stands in UTM coordinates: f32 would be half a meter off. It is looked at from straight ahead,
 * so that the tests can tell for themselves where its points are in the picture.
 */
const COUNT = 600;
const positions = georeferencedBall(COUNT);
const [X, Y, Z] = [512_345.5, 5_403_210.25, 431.75];
const FROM = `view=${X},${Y},${Z + 9}&target=${X},${Y},${Z}`;
const DISTANCE = 9;

async function openBall(query = "", options = {}): Promise<Page> {
  served.set("clouds/utm.ply", binaryPly(positions, "double", true));
  const page = await openReady(`?src=clouds/utm.ply&up=y&${FROM}${query}`, options);
  await upToDate(page);
  return page;
}

const at = (index: number): [number, number, number] => [positions[3 * index]!, positions[3 * index + 1]!, positions[3 * index + 2]!];

/** Where a point is on the screen, seen from the camera of FROM, and how far ahead. */
async function place(page: Page, index: number): Promise<{ x: number; y: number; ahead: number }> {
  const box = (await page.locator("#view").boundingBox())!;
  const [x, y, z] = at(index);
  const ahead = DISTANCE - (z - Z);
  const pixels = box.height / 2 / Math.tan(Math.PI / 8) / ahead;
  return { x: box.x + box.width / 2 + (x - X) * pixels, y: box.y + box.height / 2 - (y - Y) * pixels, ahead };
}

async function clickPoint(page: Page, index: number): Promise<void> {
  const { x, y } = await place(page, index);
  await page.mouse.click(x, y);
}

/** What is visible from the camera of the page, ascending. */
async function visible(page: Page): Promise<number[]> {
  const { viewpoint } = await status(page);
  return inNode(positions, (cloud) => [...cloud.visibleFrom(viewpoint).indices]);
}

/** Points well apart from every other in the picture, of those in `among`. */
async function lonely(page: Page, among: number[], rivals: number[]): Promise<number[]> {
  const places = new Map(await Promise.all(rivals.map(async (i) => [i, await place(page, i)] as const)));
  return among.filter((i) => {
    const own = places.get(i)!;
    return rivals.every((j) => j === i || Math.hypot(own.x - places.get(j)!.x, own.y - places.get(j)!.y) > 12);
  });
}

const everything = Array.from({ length: COUNT }, (_, i) => i);
const tool = (page: Page, name: string) => page.locator("#tool-bar").getByRole("button", { name });

test("a click tells a visible point's index and its place in full precision", async () => {
  const page = await openBall();
  const seen = await visible(page);
  const [first, second] = await lonely(page, seen, seen);
  await tool(page, "Pick").click();
  const result = page.locator("#pick-result");
  for (const index of [first!, second!]) {
    await clickPoint(page, index);
    expect(await result.locator("span").allTextContents()).toEqual([...["x", "y", "z"].map((axis, i) => `${axis} ${at(index)[i]!}`), `index ${index}`]);
    const { x, y } = await place(page, index);
    const ring = (await page.locator("#marks .ring").boundingBox())!;
    expect(ring.x + ring.width / 2).toBeCloseTo(x, 0);
    expect(ring.y + ring.height / 2).toBeCloseTo(y, 0);
  }
  // A drag turns the camera and picks nothing; the ring goes with its point.
  const before = (await page.locator("#marks .ring").boundingBox())!;
  await drag(page, 40, 0);
  expect((await settled(page)).viewpoint).not.toEqual([X, Y, Z + 9]);
  expect(await result.getAttribute("data-index")).toBe(String(second));
  expect((await page.locator("#marks .ring").boundingBox())!.x).not.toBeCloseTo(before.x, 0);

  await page.mouse.click(40, 40);
  expect(await result.textContent()).toBe("No visible point there.");
  expect(await page.locator("#marks .ring").count()).toBe(0);
});

test("hidden points are picked only through the surface", async () => {
  const page = await openBall();
  const seen = new Set(await visible(page));
  const hidden = everything.filter((i) => !seen.has(i));
  const [index] = await lonely(page, hidden, everything);
  await tool(page, "Pick").click();
  await clickPoint(page, index!);
  const result = page.locator("#pick-result");
  expect(await result.getAttribute("data-index")).toBe(null);
  await page.getByLabel("Through the surface").check();
  await clickPoint(page, index!);
  expect(await result.getAttribute("data-index")).toBe(String(index));
  expect(await page.locator("#marks .ring.hidden").count()).toBe(1);
});

test("by keyboard: P, Enter for the middle, Escape once for the point and once for the tool", async () => {
  const target = 300;
  served.set("clouds/utm.ply", binaryPly(positions, "double", true));
  const [x, y, z] = at(target);
  // From straight outside that point, which is therefore seen.
  const from = [x + 3 * (x - X), y + 3 * (y - Y), z + 3 * (z - Z)];
  const page = await openReady(`?src=clouds/utm.ply&up=y&view=${from.join()}&target=${X},${Y},${Z}`);
  await page.locator("#view").focus();
  await page.keyboard.press("p");
  expect(await tool(page, "Pick").getAttribute("aria-pressed")).toBe("true");
  await page.keyboard.press("Enter");
  expect(await page.locator("#pick-result").getAttribute("data-index")).toBe(String(target));
  await page.keyboard.press("Escape");
  expect(await page.locator("#marks .ring").count()).toBe(0);
  expect(await tool(page, "Pick").getAttribute("aria-pressed")).toBe("true");
  await page.keyboard.press("Escape");
  expect(await tool(page, "Pick").getAttribute("aria-pressed")).toBe("false");
  expect(await page.locator("#tool-card").isVisible()).toBe(false);
});
