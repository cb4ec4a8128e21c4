// Marks and the selection in the address.
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { gapsOf, indicesOf } from "../../www/tools/link.js";
import { openPage, openReady, served, upToDate } from "./support.js";

const tool = (page: Page, name: string) => page.locator("#tool-bar").getByRole("button", { name });

/** All marks, and the number of selected points. */
async function marks(page: Page) {
  return {
    measures: await page.locator("#marks .measure text").allTextContents(),
    labels: await page.locator("#label-list li span").allTextContents(),
    selected: Number(await page.locator("#select-result").getAttribute("data-count")),
  };
}

async function written(page: Page): Promise<URLSearchParams> {
  await upToDate(page);
  await page.waitForTimeout(800);
  return new URL(page.url()).searchParams;
}

/** Clicks at places around the middle of the picture. */
async function click(page: Page, ...places: [number, number][]): Promise<void> {
  const box = (await page.locator("#view").boundingBox())!;
  for (const [x, y] of places) await page.mouse.click(box.x + box.width / 2 + x, box.y + box.height / 2 + y);
}

test("indices are short as gaps, and come back", () => {
  const indices = Uint32Array.of(3, 4, 5, 6, 7, 10, 1000, 1001, 4_294_967);
  expect(gapsOf(Uint32Array.of(3, 4, 5, 6, 7, 10))).toBe("3-4.2");
  expect(indicesOf(gapsOf(indices), 5_000_000)).toEqual(indices);
  expect(indicesOf(gapsOf(indices), 4_294_967)).toBeNull();
  expect(indicesOf("0", 1)).toEqual(Uint32Array.of(0));
  for (const wrong of ["", "-", "1-", "A", "1,2", "1..2", "-5", "zzzzzzzz", "0-zzzzzzz"])
    expect(indicesOf(wrong, 100), wrong).toBeNull();
  // A text that fits into an address has all indices.
  for (let count = 1; count < 400; count++) {
    const some = Uint32Array.from({ length: count }, (_, i) => 7 * i + (i % 3));
    if (gapsOf(some).length <= 600) expect(indicesOf(gapsOf(some), 10_000)).toEqual(some);
  }
  // More runs than an address takes are given up early.
  const many = Uint32Array.from({ length: 1_000_000 }, (_, i) => 3 * i);
  expect(gapsOf(many).length).toBeGreaterThan(600);
  expect(gapsOf(many).length).toBeLessThan(700);
});

test("a link has the distances, labels and the selection, and opens with them", async () => {
  const page = await openReady("?sample=bunny");
  await tool(page, "Measure").click();
  await click(page, [-40, 0], [40, 10]);
  await page.locator("#marks .measure").waitFor({ state: "attached" });
  await tool(page, "Label").click();
  await click(page, [0, 20]);
  await page.locator("#label-text").fill("Ear, left & “<b>”");
  await page.locator("#label-text").press("Enter");
  await tool(page, "Select").click();
  await page.locator("#select-shape label", { hasText: "Box" }).click();
  const box = (await page.locator("#view").boundingBox())!;
  await page.mouse.move(box.x + box.width / 2 - 30, box.y + box.height / 2 - 30);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 30, box.y + box.height / 2 + 30);
  await page.mouse.up();
  const before = await marks(page);
  expect(before).toMatchObject({ measures: [expect.stringContaining("units")], labels: ["Ear, left & “<b>”"] });
  expect(before.selected).toBeGreaterThan(5);
  const query = await written(page);
  expect([...query.keys()]).toEqual(["sample", "measure", "label", "select"]);

  const again = await openReady(`?${query.toString()}`);
  await expect.poll(() => marks(again)).toEqual(before);
  expect((await written(again)).toString()).toBe(query.toString());
  expect(await again.locator("#message").isVisible()).toBe(false);

  // What is removed is no longer in the address.
  await tool(page, "Measure").click();
  await page.locator("#measure-clear").click();
  expect([...(await written(page)).keys()]).toEqual(["sample", "label", "select"]);
  // Marks do not go to the next cloud.
  await page.locator("#sample").selectOption("dragon_res4");
  await page.locator('#status[data-total="5205"]').waitFor();
  expect([...(await written(page)).keys()]).toEqual(["sample"]);
});

test("a selection that is too long for an address is not in the link, and a sentence says so", async () => {
  const page = await openReady("?sample=dragon_res3", { permissions: ["clipboard-read", "clipboard-write"] });
  await tool(page, "Select").click();
  await page.locator("#select-all").click();
  await tool(page, "Export").click();
  await page.getByRole("button", { name: "Copy link" }).click();
  await expect
    .poll(() => page.locator("#export-result").textContent())
    .toBe("The link is copied. Not in it, because an address would be too long: the selection.");
  expect([...(await written(page)).keys()]).toEqual(["sample"]);
});

test("marks that do not suit the cloud are left out, and a sentence says so", async () => {
  const page = await openReady("?sample=bunny&measure=1,2&measure=1,9999&label=5,Nose&label=x,Y&select=zzz");
  await expect
    .poll(() => page.locator("#message p").textContent())
    .toMatch(/^Some marks or the selection in the address/);
  expect(await marks(page)).toMatchObject({ measures: [expect.any(String)], labels: ["Nose"], selected: 0 });
  expect((await written(page)).toString()).toBe("sample=bunny&measure=1%2C2&label=5%2CNose");
});

test("the marks of a file that cannot be opened do not go to the sample that replaces it", async () => {
  served.set("clouds/empty.xyz", new Uint8Array());
  const page = await openPage("?src=clouds/empty.xyz&measure=1,2");
  await page.locator("#tools:not([hidden])").waitFor();
  await upToDate(page);
  expect((await marks(page)).measures).toEqual([]);
});
