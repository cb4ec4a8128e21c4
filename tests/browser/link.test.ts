// Marks, the selection and stations in the address.
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { gapsOf, indicesOf } from "../../www/tools/gaps.js";
import { type Marked, restore } from "../../www/tools/link.js";
import { addressWritten, openPage, openReady, served, upToDate } from "./support.js";

const tool = (page: Page, name: string) => page.locator("#tool-bar").getByRole("button", { name });

/** All marks, and the number of selected points. */
async function marks(page: Page) {
  return {
    measures: await page.locator("#marks .measure text").allTextContents(),
    labels: await page.locator("#label-list li span").allTextContents(),
    selected: Number(await page.locator("#select-result").getAttribute("data-count")),
  };
}

/** Clicks at places around the middle of the picture. */
async function click(page: Page, ...places: [number, number][]): Promise<void> {
  const box = (await page.locator("#view").boundingBox())!;
  for (const [x, y] of places) await page.mouse.click(box.x + box.width / 2 + x, box.y + box.height / 2 + y);
}

test("indices are short as gaps, and come back", () => {
  const indices = Uint32Array.of(3, 4, 5, 6, 7, 10, 1000, 1001, 4_294_967);
  expect(gapsOf(Uint32Array.of(3, 4, 5, 6, 7, 10), 600)).toBe("3-4.2");
  expect(indicesOf(gapsOf(indices, 600), 5_000_000)).toEqual(indices);
  expect(indicesOf(gapsOf(indices, 600), 4_294_967)).toBeNull();
  expect(indicesOf("0", 1)).toEqual(Uint32Array.of(0));
  for (const wrong of ["", "-", "1-", "A", "1,2", "1..2", "-5", "zzzzzzzz", "0-zzzzzzz"]) {
    expect(indicesOf(wrong, 100), wrong).toBeNull();
  }
  // A text that fits into an address has all indices.
  for (let count = 1; count < 400; count++) {
    const some = Uint32Array.from({ length: count }, (_, i) => 7 * i + (i % 3));
    if (gapsOf(some, 600).length <= 600) expect(indicesOf(gapsOf(some, 600), 10_000)).toEqual(some);
  }
  // More runs than an address takes are given up early.
  const many = Uint32Array.from({ length: 1_000_000 }, (_, i) => 3 * i);
  expect(gapsOf(many, 600).length).toBeGreaterThan(600);
  expect(gapsOf(many, 600).length).toBeLessThan(700);
});

test("a link has the distances, labels and the selection, and opens with them", async () => {
  const page = await openReady("?sample=bunny&size=1.4");
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
  const query = await addressWritten(page);
  expect([...query.keys()]).toEqual(["sample", "size", "measure", "label", "select"]);

  const again = await openReady(`?${query.toString()}`);
  await expect.poll(() => marks(again)).toEqual(before);
  expect((await addressWritten(again)).toString()).toBe(query.toString());
  expect(await again.locator("#message").isVisible()).toBe(false);

  // What is removed is no longer in the address.
  await tool(page, "Measure").click();
  await page.locator("#measure-clear").click();
  expect([...(await addressWritten(page)).keys()]).toEqual(["sample", "size", "label", "select"]);
  // Marks do not go to the next cloud.
  await page.locator("#sample").selectOption("dragon_res4");
  await page.locator('#status[data-total="5205"]').waitFor();
  expect([...(await addressWritten(page)).keys()]).toEqual(["sample"]);
});

/** What the cards say about an area or a profile, and about stations. */
async function cards(page: Page) {
  const { length } = new URL(page.url()).searchParams.getAll("station");
  if (length > 0) await page.locator("#stations-unseen[data-count]").waitFor({ state: "attached" });
  return {
    measured: await page.locator("#measure-result").textContent(),
    profile: await page.locator(".profile canvas").evaluateAll((all) => all.map((canvas) => canvas.ariaLabel)),
    stations: await page
      .locator("#stations-card tbody tr")
      .evaluateAll((rows) => rows.map((row) => [...row.children].map((cell) => cell.textContent))),
  };
}

test("a link has the area or the profile, and the stations, and opens with them", async () => {
  const page = await openReady("?sample=bunny&size=1.4");
  await tool(page, "Measure").click();
  await page.locator("#measure-what label", { hasText: "Area" }).click();
  await expect.poll(() => page.locator("#measure-result").textContent()).toBe("Click the corners.");
  await click(page, [-40, 0], [40, 10], [0, 60], [-30, 40]);
  await expect.poll(() => page.locator("#marks .measure").count()).toBe(4);
  await tool(page, "Stations").click();
  await page.getByRole("button", { name: "At the camera" }).click();
  const first = await cards(page);
  expect(first.measured).toMatch(/^Corners ?4.*Area/);
  const query = await addressWritten(page);
  expect([...query.keys()]).toEqual(["sample", "size", "area", "station"]);

  const again = await openReady(`?${query.toString()}`);
  await again.locator("#marks .measure").nth(3).waitFor({ state: "attached" });
  expect(await cards(again)).toEqual(first);
  expect((await addressWritten(again)).toString()).toBe(query.toString());

  // A profile takes the place of the area. Here it has hidden points, too.
  await tool(again, "Measure").click();
  await again.getByLabel("Through the surface").check();
  await again.locator("#measure-what label", { hasText: "Profile" }).click();
  await expect.poll(() => again.locator("#measure-result").textContent()).toBe("Click both ends of the profile.");
  await click(again, [-40, 0], [40, 10]);
  await expect.poll(() => again.locator("#marks .measure").count()).toBe(1);
  await again.getByLabel("Width of the strip").fill("1.25");
  await again.getByLabel("Width of the strip").press("Tab");
  const second = await cards(again);
  const changed = await addressWritten(again);
  expect([...changed.keys()]).toEqual(["sample", "size", "profile", "station"]);
  expect(changed.get("profile")).toMatch(/^\d+,\d+,1\.25,through$/);

  const last = await openReady(`?${changed.toString()}`);
  await last.locator("#marks .measure").waitFor({ state: "attached" });
  expect({ ...(await cards(last)), measured: "" }).toEqual({ ...second, measured: "" });
  expect(await last.locator("#through").isChecked()).toBe(true);
  expect((await addressWritten(last)).toString()).toBe(changed.toString());
  expect(await last.locator("#message").isVisible()).toBe(false);
});

/** Restores an address in a cloud of 100 points. Returns what the tools were told, and whether all of it suits. */
async function restored(search: string, count = 100) {
  const told: unknown[] = [];
  const tool = (name: string) => ({ [name]: (...given: unknown[]) => void told.push([name, ...given]) });
  const through = { checked: false };
  const measure = {
    ...tool("measure"),
    ready: (mode: string) => Promise.resolve((...given: unknown[]) => void told.push([mode, ...given])),
  };
  const stations = { ready: () => Promise.resolve({ add: (all: unknown) => void told.push(all) }) };
  const marked = { measure, label: tool("add"), select: tool("choose"), stations, through } as unknown as Marked;
  const isWhole = await restore(search, marked, count, () => Promise.resolve(true));
  return { told, isWhole, through: through.checked };
}

test("of an area, a profile and stations in an address, only what suits the cloud is taken", async () => {
  const area = ["area", [1, 2, 99], undefined];
  const here = { name: "A, b", at: [1, -2.5, 3e5] };
  for (const [search, told, isWhole] of [
    ["area=1,2,99", [area], true],
    ["area=1,2", [], false],
    ["area=1,2,100", [], false],
    ["area=1,2,", [], false],
    ["area=1,2,99&area=1,2,3", [area], false],
    ["area=1,2,99&profile=1,2,3", [area], false],
    ["profile=1,2,0.5", [["profile", [1, 2], 0.5]], true],
    ["profile=1,2", [], false],
    ["profile=1,2,0", [], false],
    ["profile=1,100,3", [], false],
    ["profile=1,2,3,behind", [], false],
    ["profile=1,2,3,through,4", [], false],
    ["station=1,-2.5,3e5,A, b", [[here]], true],
    ["station=1,-2.5,3e5,A, b&station=x,2,3,C", [[here]], false],
    ["station=1,2,North", [], false],
    ["station=1,2,3,", [], false],
  ] as const) {
    expect(await restored(search), search).toEqual({ told, isWhole, through: false });
  }
  expect(await restored("profile=1,2,0.5,through")).toMatchObject({ isWhole: true, through: true });
  // The points of a streamed cloud come and go.
  expect(await restored("area=1,2,3&station=1,2,3,A", 0)).toMatchObject({ told: [], isWhole: false });
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
  expect([...(await addressWritten(page)).keys()]).toEqual(["sample"]);
});

test("marks that do not suit the cloud are left out, and a sentence says so", async () => {
  const page = await openReady("?sample=bunny&measure=1,2&measure=1,9999&label=5,Nose&label=x,Y&select=zzz");
  await expect
    .poll(() => page.locator("#message p").textContent())
    .toMatch(/^Some marks, stations or the selection in the address/);
  expect(await marks(page)).toMatchObject({ measures: [expect.any(String)], labels: ["Nose"], selected: 0 });
  expect((await addressWritten(page)).toString()).toBe("sample=bunny&measure=1%2C2&label=5%2CNose");
});

test("the marks of a file that cannot be opened do not go to the sample that replaces it", async () => {
  served.set("clouds/empty.xyz", new Uint8Array());
  const page = await openPage("?src=clouds/empty.xyz&measure=1,2");
  await page.locator("#tools:not([hidden])").waitFor();
  await upToDate(page);
  expect((await marks(page)).measures).toEqual([]);
});
