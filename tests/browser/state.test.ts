import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { addressWritten, drag, openReady, type Status, unfold, upToDate } from "./support.js";

/** The query of the address, after the page has written its last change. */
async function written(page: Page): Promise<string> {
  await addressWritten(page);
  return new URL(page.url()).search;
}

function same({ visible, viewpoint, radius, inversion }: Status) {
  return { visible, viewpoint, radius, inversion };
}

test("a copied address shows the same cloud, camera and settings again", async () => {
  const page = await openReady("?sample=dragon_res4");
  await unfold(page, "Advanced");
  await page.getByRole("radio", { name: "2 looks" }).check();
  await page.getByRole("radio", { name: "Ghost" }).check();
  await unfold(page, "Look");
  await page.getByLabel("Point size").fill("2");
  await page.getByLabel("Field of view", { exact: true }).fill("30");
  await drag(page, 90, 40);
  await drag(page, 80, -50, "right");
  const query = await written(page);
  expect(query).toMatch(/^\?sample=dragon_res4&/);
  for (const part of ["looks=2", "hidden=dimmed", "size=2", "fov=30", "view=", "target="]) {
    expect(query).toContain(part);
  }
  const before = same(await upToDate(page));
  const again = await openReady(query);
  expect(same(await upToDate(again))).toEqual(before);
  expect(await again.getByLabel("Point size").inputValue()).toBe("2");
  expect(await again.getByLabel("Field of view", { exact: true }).inputValue()).toBe("30");
  expect(await again.getByRole("radio", { name: "Ghost" }).isChecked()).toBe(true);
  expect(await written(again)).toBe(query);
});

test("the address also restores the length of the radius, the frozen viewpoint and the up axis", async () => {
  const page = await openReady("?sample=bunny&radius=40");
  await unfold(page, "Look");
  await page.locator("#up-axis").getByRole("radio", { name: "Z", exact: true }).check();
  await page.locator("#view").press("v");
  await drag(page, 120, 0);
  const query = await written(page);
  for (const part of ["radius=40", "up=z", "freeze=", "view="]) {
    expect(query).toContain(part);
  }
  const again = await openReady(query);
  expect(same(await upToDate(again))).toEqual(same(await upToDate(page)));
  expect(await again.locator("#walk").getAttribute("aria-pressed")).toBe("true");
  expect(await again.locator("#up-axis").getByRole("radio", { name: "Z", exact: true }).isChecked()).toBe(true);
});

test("at the first view and with the usual settings the address is empty", async () => {
  const page = await openReady("?sample=dragon_res4");
  await unfold(page, "Advanced");
  await page.getByLabel("Exponent", { exact: true }).fill("2");
  await drag(page, 50, 0);
  expect(await written(page)).toMatch(/exponent=2.*view=/);
  await page.getByRole("button", { name: "Automatic" }).click();
  await page.getByRole("button", { name: "Reset view" }).click();
  expect(await written(page)).toBe("?sample=dragon_res4");
});

test("a radius and an exponent exclude each other", async () => {
  const page = await openReady("?sample=bunny&radius=40&exponent=2");
  expect((await upToDate(page)).exponent).toBeCloseTo(2, 12);
  expect(await page.locator("#message p").textContent()).toMatch(/exclude each other/);
});

test("the settings of one cloud do not go to the next", async () => {
  const page = await openReady("?sample=bunny&view=1,8,-12&freeze=1,8,-12&size=2&radius=40&hidden=shown");
  await upToDate(page);
  await page.locator("#sample").selectOption("dragon_res4");
  await page.locator('#status[data-total="5205"]').waitFor();
  const query = await written(page);
  expect(new URLSearchParams(query).get("hidden")).toBe("shown");
  for (const gone of ["view", "freeze", "size", "radius"]) expect(query).not.toContain(`${gone}=`);
});

test("data-busy is 1 from a change until its answer is there", async () => {
  const page = await openReady("?sample=bunny");
  await upToDate(page);
  const busy = await page.evaluate(() => {
    document.querySelector<HTMLElement>('#looks [value="2"]')!.click();
    return document.getElementById("status")!.dataset["busy"];
  });
  expect(busy).toBe("1");
  expect((await upToDate(page)).inversion).toMatch(/^looks:[^,]+,[^,]+$/);
});
