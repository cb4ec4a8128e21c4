// Stations: what several viewpoints see together, and none. Checked against the package in Node.
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { at, clickPoint, lonely, MIDDLE, openBall, positions, tool, visible } from "./ball.js";
import { inNode } from "./support.js";

const [X, Y, Z] = MIDDLE;
const PLACES: [string, number[]][] = [
  ["north", [X, Y, Z + 9]],
  ["east", [X + 7, Y + 1, Z]],
  ["below, far", [X - 2, Y - 12, Z - 3]],
];
const names = (page: Page) => page.locator("#stations-card .list span").allTextContents();

/** How many points of the ball none of these places sees, with the package. */
const expected = (places: readonly number[][]) =>
  inNode(positions, (cloud) => [...cloud.coverage(places, { looks: 3 })].filter((count) => count === 0).length);

test("stations of an address: the counts, and the points that none sees are the package's", async () => {
  const stations = PLACES.map(([name, place]) => `&station=${place.join()},${encodeURIComponent(name)}`);
  const page = await openBall({}, undefined, undefined, undefined, stations.join(""));
  await tool(page, "Stations").click();
  const unseen = await expected(PLACES.map(([, place]) => place));
  await expect.poll(() => page.locator("#stations-unseen").getAttribute("data-count")).toBe(String(unseen));
  expect(await names(page)).toEqual(PLACES.map(([name]) => name));
  expect(await page.locator("#marks .pin text").allTextContents()).toEqual(PLACES.map(([name]) => name));

  // Points are colored by their counts. The legend has the number of points of each count.
  expect(await page.locator("#color").inputValue()).toBe("seen by stations");
  const legend = (await page.locator("#legend .count").allTextContents()).map((text) => Number(text.replace(",", "")));
  expect(legend.reduce((a, b) => a + b)).toBe(600);
  expect(legend[0]).toBe(unseen);
  expect(new URL(page.url()).searchParams.has("color")).toBe(false);
});

test("a click places a station above the point, and one can be removed", async () => {
  const page = await openBall();
  const seen = await visible(page);
  const [index] = await lonely(page, seen, seen);
  await tool(page, "Stations").click();
  await page.getByLabel("Height above a clicked point").fill("1.5");
  await clickPoint(page, index!);
  const [x, y, z] = at(index!);
  const unseen = await expected([[x, y + 1.5, z]]);
  await expect.poll(() => page.locator("#stations-unseen").getAttribute("data-count")).toBe(String(unseen));
  await page.getByRole("button", { name: "At the camera" }).click();
  const both = await expected([
    [x, y + 1.5, z],
    [X, Y, Z + 9],
  ]);
  await expect.poll(() => page.locator("#stations-unseen").getAttribute("data-count")).toBe(String(both));
  expect(await names(page)).toEqual(["S1", "S2"]);
  await page.getByRole("button", { name: "Remove the station S1" }).click();
  const last = await expected([[X, Y, Z + 9]]);
  await expect.poll(() => page.locator("#stations-unseen").getAttribute("data-count")).toBe(String(last));
  await page.getByRole("button", { name: "Remove all" }).click();
  expect(await page.locator("#marks .pin").count()).toBe(0);
  expect(await page.locator("#color").inputValue()).toBe("own");
});
