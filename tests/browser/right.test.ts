import { expect, test } from "vitest";
import { asciiPly, ball } from "./clouds.js";
import { openReady, served } from "./support.js";

test("How right is it? has the errors of the comparison with the true surface, and the looks' are the fewest", async () => {
  // The whole bunny is in the picture, so both count the same points.
  const page = await openReady("?sample=bunny&compare=0.5&against=surface");
  const figures = page.locator("#compare-figures");
  await expect.poll(() => figures.getAttribute("data-counts"), { timeout: 60_000 }).toMatch(/\d,/);
  const [, , wrong, missed, hullWrong, hullMissed] = (await figures.getAttribute("data-counts"))!
    .split(",")
    .map(Number);
  await page.getByRole("button", { name: "How right is it?" }).click();
  const rows = page.locator("#right tbody tr");
  await rows.first().waitFor();
  const shares = await rows.evaluateAll((all) =>
    all.map((row) => [...row.querySelectorAll("td")].slice(0, 3).map((cell) => Number.parseFloat(cell.textContent))),
  );
  const total = await page.locator("#status").getAttribute("data-total");
  const share = (count: number) => Number(((100 * count) / Number(total)).toFixed(2));
  expect(shares[1]!.slice(0, 2)).toEqual([share(hullWrong!), share(hullMissed!)]);
  expect(shares[2]!.slice(0, 2)).toEqual([share(wrong!), share(missed!)]);
  expect(await page.locator("#right .best th").textContent()).toMatch(/^Three looks/);
  expect(await page.locator("#right canvas").count()).toBe(3);
  await page.keyboard.press("Escape");
  expect(await page.locator("#right").count()).toBe(0);
});

test("a cloud without a known surface says so", async () => {
  served.set("clouds/ball.ply", asciiPly(ball(300)));
  const page = await openReady("?src=clouds/ball.ply");
  await page.getByRole("button", { name: "How right is it?" }).click();
  await expect.poll(() => page.locator("#right p").textContent()).toMatch(/^Nobody knows which points/);
});
