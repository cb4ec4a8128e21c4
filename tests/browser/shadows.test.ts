import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { asciiPly } from "./clouds.js";
import { hold, holdable, release } from "./held.js";
import {
  addressWritten,
  brightness,
  differentPixels,
  EVERY_PIXEL,
  openReady,
  picture,
  served,
  status,
  unfold,
  upToDate,
} from "./support.js";
import { addStyle } from "./site.js";

/** A wall of two by two, and a small plate in front of its middle. */
function wall(): number[] {
  const positions: number[] = [];
  for (let i = 0; i <= 60; i++) for (let j = 0; j <= 60; j++) positions.push(-1 + i / 30, -1 + j / 30, 0);
  for (let i = 0; i <= 10; i++) for (let j = 0; j <= 10; j++) positions.push(-0.1 + i / 50, -0.1 + j / 50, 0.5);
  return positions;
}

/** Seen from straight ahead. The light comes from the left, so that the plate's shadow lies 0.45 to 0.75 to the right. */
const FROM = "?src=clouds/wall.ply&view=0,0,4&smoothing=0&size=2";
const LEFT_LIGHT = "&light=-1.2,0,1.5";

async function openWall(query: string): Promise<Page> {
  served.set("clouds/wall.ply", asciiPly(wall()));
  const page = await openReady(FROM + query, EVERY_PIXEL);
  await upToDate(page);
  return page;
}

/** The brightness of the wall at this distance to the right of its middle. */
async function brightnessAt(page: Page, right: number): Promise<number> {
  const { width, height } = (await page.locator("#view").boundingBox())!;
  const pixels = height / 2 / (4 * Math.tan(Math.PI / 8));
  return brightness(page, await picture(page), width / 2 + right * pixels, height / 2, 9);
}

/** The lights in the address, after it was written. */
async function lightsInAddress(page: Page, count: number): Promise<number[][]> {
  const lights = (await addressWritten(page)).getAll("light").map((light) => light.split(",").map(Number));
  expect(lights).toHaveLength(count);
  return lights;
}

test.for(["points", "surface"])("on the %s, places that a light does not reach are dark", async (show) => {
  const page = await openWall(`&show=${show}${LEFT_LIGHT}`);
  expect((await status(page)).lights).toBe(1);
  const lit = await brightnessAt(page, -0.6);
  const shadowed = await brightnessAt(page, 0.6);
  // Only the ambient light reaches the shadow.
  expect(shadowed / lit).toBeCloseTo(0.3, 1);
  await page.getByLabel("Ambient light").fill("0.6");
  await upToDate(page);
  expect((await brightnessAt(page, 0.6)) / lit).toBeCloseTo(0.6, 1);
});

test("two lights halve each other's shadows", async () => {
  const page = await openWall(`${LEFT_LIGHT}&light=1.2,0,1.5&ambient=0`);
  expect((await status(page)).lights).toBe(2);
  const lit = await brightnessAt(page, 0.95);
  for (const side of [0.6, -0.6]) expect((await brightnessAt(page, side)) / lit).toBeCloseTo(0.5, 1);
});

test("a soft light has shadows with a soft edge", async () => {
  const page = await openWall(`${LEFT_LIGHT}&ambient=0`);
  const sharp = await picture(page);
  const lit = await brightnessAt(page, -0.6);
  await page.getByLabel("Soft edges").fill("0.3");
  await upToDate(page);
  expect(await differentPixels(page, sharp, await picture(page))).toBeGreaterThan(1000);
  // A place that was light is now between light and dark.
  const edge = (await brightnessAt(page, 0.8)) / lit;
  expect(edge).toBeGreaterThan(0.1);
  expect(edge).toBeLessThan(0.95);
});

test.for(["points", "surface"])("on the %s, only the lights cause shades", async (show) => {
  // A light at the camera’s place sees all that one hull sees from there, so everything has full brightness.
  const headlight = await openWall(`&show=${show}&light=0,0,4&ambient=0&looks=0`);
  const bright = await openWall(`&show=${show}&light=9,9,9&ambient=1&looks=0`);
  const handle = "#lights { display: none }";
  for (const page of [headlight, bright]) await addStyle(page, handle);
  expect(await differentPixels(headlight, await picture(headlight), await picture(bright))).toBe(0);
});

test("lights are added, dragged, moved by keys, brought to the camera and removed", async () => {
  const page = await openReady("?sample=dragon_res4");
  const unlit = await picture(page);
  await unfold(page, "Light and shadow");
  expect(await page.getByLabel("Soft edges").isDisabled()).toBe(true);
  await page.getByRole("button", { name: "Add a light" }).click();
  expect((await upToDate(page)).lights).toBe(1);
  const handle = page.getByRole("button", { name: /^Light 1/ });
  const before = (await handle.boundingBox())!;
  expect(await differentPixels(page, unlit, await picture(page))).toBeGreaterThan(5000);
  const [added] = await lightsInAddress(page, 1);

  const viewpoint = (await status(page)).viewpoint;
  await page.mouse.move(before.x + before.width / 2, before.y + before.height / 2);
  await page.mouse.down();
  await page.mouse.move(before.x + before.width / 2 + 90, before.y + before.height / 2 + 60, { steps: 6 });
  await page.mouse.up();
  const dragged = (await handle.boundingBox())!;
  expect(dragged.x - before.x).toBeCloseTo(90, 0);
  expect(dragged.y - before.y).toBeCloseTo(60, 0);
  const [moved] = await lightsInAddress(page, 1);
  expect(moved).not.toEqual(added);
  // The camera has stayed.
  expect((await upToDate(page)).viewpoint).toEqual(viewpoint);

  await handle.focus();
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowUp");
  const [turned] = await lightsInAddress(page, 1);
  expect(turned).not.toEqual(moved);
  await page.getByRole("button", { name: "To camera: light 1" }).click();
  await page.keyboard.press("ArrowLeft");
  const [beside] = await lightsInAddress(page, 1);
  expect(beside).not.toEqual(turned);
  expect(beside).not.toEqual(viewpoint);
  expect(Math.hypot(...beside!.map((value, axis) => value - viewpoint[axis]!))).toBeLessThan(
    0.1 * Math.hypot(...viewpoint),
  );

  await page.getByRole("button", { name: "Add a light" }).click();
  expect((await upToDate(page)).lights).toBe(2);
  // The next light takes the free place.
  await page.getByRole("button", { name: "Remove light 1" }).click();
  await page.getByRole("button", { name: "Add a light" }).click();
  expect((await upToDate(page)).lights).toBe(2);
  const [one, two] = await lightsInAddress(page, 2);
  expect(one).not.toEqual(two);
  await page.getByRole("button", { name: "Remove light 1" }).click();
  expect((await upToDate(page)).lights).toBe(1);
  await page.getByRole("button", { name: "Remove light 1" }).click();
  expect((await upToDate(page)).lights).toBeUndefined();
  // Without the ring of the keyboard focus, the picture equals the first one.
  expect(await differentPixels(page, unlit, await picture(page))).toBe(0);
});

test("the surface keeps its light while the camera moves, and is lit anew when it rests", async () => {
  const page = await openWall(`&show=surface${LEFT_LIGHT}`);
  await page.locator("#view").press("ArrowLeft");
  const now = await upToDate(page);
  expect(now).toMatchObject({ lights: 1, show: "surface" });
  const lit = await brightnessAt(page, -0.6);
  await page.locator("#view").press("ArrowRight");
  await upToDate(page);
  expect((await brightnessAt(page, 0.6)) / lit).toBeLessThan(0.4);
});

test("a sign says that a light is being computed", async () => {
  const page = await openReady("?sample=dragon_res4", {}, holdable);
  await hold(page);
  await unfold(page, "Light and shadow");
  await page.getByRole("button", { name: "Add a light" }).click();
  await page.locator("#sign-work").waitFor();
  expect((await status(page)).busy).toBe(1);
  await release(page);
  await upToDate(page);
  expect(await page.locator("#sign-work").isVisible()).toBe(false);
});
