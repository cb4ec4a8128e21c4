import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { asciiPly, ball } from "./clouds.js";
import { openReady, PHONE, served } from "./support.js";
import { differentPixels } from "./pixels.js";

async function openLesson(page: Page): Promise<void> {
  await page.getByRole("button", { name: "How it works" }).click();
  await page.locator("#how [data-say]:not(:empty)").waitFor();
}

/** The numbers of the legend: seen, hidden, wrong, missed. */
function counts(page: Page): Promise<number[]> {
  return page
    .locator("#how .legend li")
    .evaluateAll((rows) => rows.map((row) => Number(row.textContent.split(" ")[0]!.replaceAll(",", ""))));
}

async function choose(page: Page, exponent: string): Promise<number[]> {
  const before = await page.locator("#how output").textContent();
  await page.locator("#how-radius").fill(exponent);
  await expect.poll(() => page.locator("#how output").textContent()).not.toBe(before);
  return counts(page);
}

test("the lesson shows the flip and its hull, and lights what another radius changes", async () => {
  const page = await openReady("?sample=bunny");
  const asked: string[] = [];
  page.on("request", (request) => asked.push(request.url()));
  await openLesson(page);
  // It is loaded only now.
  expect(asked.some((address) => address.includes("/assets/how-"))).toBe(true);
  const flipped = page.locator('#how [data-picture="flipped"]');
  const usual = await flipped.screenshot();
  const [seen, hidden, wrong, missed] = await counts(page);
  expect(seen! + hidden! + wrong! + missed!).toBe(1839);
  expect(seen).toBeGreaterThan(500);

  const large = await choose(page, "5");
  expect(large[2]).toBeGreaterThan(wrong! + 500);
  expect(await page.locator("#how [data-say]").textContent()).toContain("Too large");
  expect(await differentPixels(usual, await flipped.screenshot())).toBeGreaterThan(1000);

  const small = await choose(page, "0.1");
  expect(small[3]).toBeGreaterThan(missed! + 300);
  expect(await page.locator("#how [data-say]").textContent()).toContain("Too small");

  await page.getByRole("button", { name: "Automatic radius" }).click();
  await expect.poll(() => counts(page)).toEqual([seen, hidden, wrong, missed]);
  await page.keyboard.press("Escape");
  await expect.poll(() => page.locator("#how").count()).toBe(0);
});

test("on a phone, too, a radius that is too large is compared with the automatic one", async () => {
  served.set("clouds/ball.ply", asciiPly(ball(5000)));
  const page = await openReady("?src=clouds/ball.ply&looks=0", PHONE);
  await page.getByRole("button", { name: "More controls" }).click();
  await openLesson(page);
  expect((await counts(page)).slice(2)).toEqual([0, 0]);
  const large = await choose(page, "5");
  expect(large[2]).toBeGreaterThan(100);
  expect(await page.locator("#how .legend").textContent()).toContain("than with the automatic radius");
  const overflow = await page.locator("#how").evaluate((dialog) => dialog.scrollWidth - dialog.clientWidth);
  expect(overflow).toBe(0);
});
