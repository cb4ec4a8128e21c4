// Stations: what several viewpoints see together, each one alone, and none. Checked against the package in Node.
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { at, clickPoint, lonely, MIDDLE, openBall, positions, tool, visible } from "./ball.js";
import { hold, holdable } from "./held.js";
import { inNode } from "./support.js";

const [X, Y, Z] = MIDDLE;
const PLACES: [string, number[]][] = [
  ["north", [X, Y, Z + 9]],
  ["east", [X + 7, Y + 1, Z]],
  ["below, far", [X - 2, Y - 12, Z - 3]],
];
const number = (value: number) => value.toLocaleString("en-US");

const table = (page: Page) =>
  page
    .locator("#stations-card tbody tr")
    .evaluateAll((rows) => rows.map((row) => [...row.children].slice(0, 3).map((cell) => cell.textContent)));

/** What the card has to say about stations. */
async function expected(stations: readonly (readonly [string, number[]])[]) {
  return inNode(positions, (cloud) => {
    const masks = stations.map(([, place]) => cloud.visibleFrom(place, { looks: 3 }).mask());
    const counts = [
      ...cloud.coverage(
        stations.map(([, place]) => place),
        { looks: 3 },
      ),
    ];
    const rows = stations.map(([name], s) => [
      name,
      number(masks[s]!.reduce((sum, value) => sum + value, 0)),
      number(masks[s]!.filter((value, i) => value === 1 && counts[i] === 1).length),
    ]);
    return { counts, rows, unseen: counts.filter((count) => count === 0).length };
  });
}

test("stations of an address: each one's figures, the counts, and the points that none sees are the package's", async () => {
  const stations = PLACES.map(([name, place]) => `&station=${place.join()},${encodeURIComponent(name)}`);
  const page = await openBall({}, undefined, undefined, undefined, stations.join(""));
  await tool(page, "Stations").click();
  const { rows, unseen } = await expected(PLACES);
  await expect.poll(() => page.locator("#stations-unseen").getAttribute("data-count")).toBe(String(unseen));
  expect(await table(page)).toEqual(rows);
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
  const { rows, unseen } = await expected([["S1", [x, y + 1.5, z]]]);
  await expect.poll(() => page.locator("#stations-unseen").getAttribute("data-count")).toBe(String(unseen));
  expect(await table(page)).toEqual(rows);
  await page.getByRole("button", { name: "At the camera" }).click();
  const both = await expected([
    ["S1", [x, y + 1.5, z]],
    ["S2", [X, Y, Z + 9]],
  ]);
  await expect.poll(() => page.locator("#stations-unseen").getAttribute("data-count")).toBe(String(both.unseen));
  expect(await table(page)).toEqual(both.rows);
  await page.getByRole("button", { name: "Remove the station S1" }).click();
  const last = await expected([["S2", [X, Y, Z + 9]]]);
  await expect.poll(() => page.locator("#stations-unseen").getAttribute("data-count")).toBe(String(last.unseen));
  await page.getByRole("button", { name: "Remove all" }).click();
  expect(await page.locator("#marks .pin").count()).toBe(0);
  expect(await page.locator("#color").inputValue()).toBe("own");
});

test("a long question about stations can be stopped", async () => {
  const page = await openBall({}, undefined, undefined, holdable);
  await tool(page, "Stations").click();
  // The workers are held back, so that the question surely lasts until it is stopped.
  await hold(page);
  await page.getByRole("button", { name: "At the camera" }).click();
  const stop = page.getByRole("button", { name: "Stop" });
  await stop.click();
  await expect.poll(() => page.locator("#stations-card output").textContent()).toBe("Stopped.");
  expect(await stop.isVisible()).toBe(false);
  expect((await table(page)).map(([name]) => name)).toEqual(["S1"]);
});
