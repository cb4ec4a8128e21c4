import { expect, test } from "vitest";
import {
  browser,
  differentPixels,
  drag,
  openReady,
  picture,
  serveSmallDragon,
  site,
  status,
  upToDate,
} from "./support.js";

serveSmallDragon();

test("a first visit offers a guide, which can be stepped through or skipped, and is remembered", async () => {
  const page = await openReady("");
  const guide = page.getByRole("group", { name: "Guide" });
  await guide.getByRole("button", { name: "Show me" }).click();
  const home = (await status(page)).viewpoint;
  expect(await page.locator("#divider").isVisible()).toBe(true);
  await guide.getByRole("button", { name: "Next" }).click();
  expect(await page.locator("#divider").isVisible()).toBe(false);
  expect(await page.getByRole("radio", { name: "Shown" }).isChecked()).toBe(true);
  await guide.getByRole("button", { name: "Next" }).click();
  expect(await page.locator("#freeze").getAttribute("aria-pressed")).toBe("true");
  await guide.getByRole("button", { name: "Next" }).click();
  await guide.getByRole("button", { name: "Done" }).click();
  expect(await guide.count()).toBe(0);
  // Everything is as it was.
  expect((await upToDate(page)).viewpoint).toEqual(home);
  expect(await page.locator("#freeze").getAttribute("aria-pressed")).toBe("false");
  expect(await page.getByRole("radio", { name: "Off" }).isChecked()).toBe(true);

  await page.reload();
  await page.locator("#tool-bar").waitFor();
  expect(await guide.count()).toBe(0);
});

test("the guide walks around, and ends at the user's own first move; an address that asks for something has none", async () => {
  const context = await browser.newContext({ viewport: { width: 1000, height: 700 }, deviceScaleFactor: 0.5 });
  const page = await context.newPage();
  // A step ends only by a click. A busy machine may take longer for two pictures than the step lasts.
  await page.addInitScript(() => {
    const own = setTimeout;
    Object.assign(globalThis, {
      setTimeout: (act: () => void, delay = 0) => own(act, delay === 5000 ? 1_000_000 : delay),
    });
  });
  await page.goto(site.address);
  const guide = page.getByRole("group", { name: "Guide" });
  await guide.getByRole("button", { name: "Show me" }).click({ timeout: 120_000 });
  for (let i = 0; i < 2; i++) await guide.getByRole("button", { name: "Next" }).click();
  const before = await picture(page);
  await expect.poll(async () => differentPixels(page, before, await picture(page))).toBeGreaterThan(500);
  await drag(page, 60, 10);
  expect(await guide.count()).toBe(0);
  await context.close();

  const asked = await openReady("?sample=bunny");
  await asked.locator("#tool-bar").waitFor();
  expect(await asked.getByRole("group", { name: "Guide" }).count()).toBe(0);
});
