// A part of a cloud: classes that are left out, and a box.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, test } from "vitest";
import { make as makeTile } from "../../www/samples/tile.js";
import { differentPixels } from "./pixels.js";
import { addressWritten, inNode, openReady, picture, served, settled, unfold, upToDate } from "./support.js";

test("classes that are left out are neither seen nor hide anything, and the address has them", async () => {
  const { positions, attributes } = makeTile();
  const kinds = attributes![1]!.values;
  const page = await openReady("?sample=tile&looks=0");
  const whole = await picture(page);
  await unfold(page, "Part of the cloud");
  for (const name of ["high vegetation", "building"]) await page.getByLabel(name, { exact: true }).uncheck();
  const { viewpoint, visible } = await settled(page);
  const mask = Uint8Array.from(kinds, (kind) => Number(kind !== 5 && kind !== 6));
  expect(visible).toBe(await inNode(positions, (cloud) => cloud.visibleFrom(viewpoint, { within: { mask } }).count));
  expect(await differentPixels(whole, await picture(page))).toBeGreaterThan(2000);
  expect((await addressWritten(page)).get("without")).toBe("classification:5,6");
  await page.getByRole("button", { name: "All points" }).click();
  await settled(page);
  expect(await page.getByLabel("building", { exact: true }).isChecked()).toBe(true);
  expect(await differentPixels(whole, await picture(page))).toBe(0);
});

test("a box clips the cloud, from the address, by its sides and around the selection", async () => {
  const { positions } = makeTile();
  const box = [
    [512_100, 5_403_100, 400],
    [512_200, 5_403_250, 500],
  ] as [number[], number[]];
  const page = await openReady(`?sample=tile&box=${box.flat().join()}`);
  const inBox = async (given: typeof box) => {
    const { viewpoint } = await settled(page);
    return inNode(positions, (cloud) => cloud.visibleFrom(viewpoint, { looks: 3, within: { box: given } }).count);
  };
  expect((await upToDate(page)).visible).toBe(await inBox(box));
  await unfold(page, "Part of the cloud");
  await page.getByLabel("x to", { exact: true }).fill("512150");
  await page.getByLabel("x to", { exact: true }).press("Enter");
  const smaller = [box[0], [512_150, ...box[1].slice(1)]] as typeof box;
  expect((await settled(page)).visible).toBe(await inBox(smaller));
  await page.locator("#tool-select").click();
  const view = (await page.locator("#view").boundingBox())!;
  const [x, y] = [view.x + view.width / 2, view.y + view.height / 2];
  await page.mouse.move(x - 40, y - 40);
  await page.mouse.down();
  for (const [dx, dy] of [[40, -40], [40, 40], [-40, 40]] as const) await page.mouse.move(x + dx, y + dy); // prettier-ignore
  await page.mouse.up();
  await expect
    .poll(async () => Number(await page.locator("#select-result").getAttribute("data-count")))
    .toBeGreaterThan(0);
  await page.getByRole("button", { name: "Box of the selection" }).click();
  await settled(page);
  const written = (await addressWritten(page)).get("box")!.split(",").map(Number);
  expect((await settled(page)).visible).toBe(await inBox([written.slice(0, 3), written.slice(3)]));
  expect(written[3]).toBeLessThanOrEqual(512_150);
});

test("a column that the cloud does not have is told, and values that cannot be used, too", async () => {
  const page = await openReady("?sample=bunny&without=mood:1&box=1,2,3,0,0,0");
  const message = await page.locator("#message p").textContent();
  expect(message).toContain("The cloud has no “mood”, so no class is left out.");
  expect(message).toContain("The box in the address is not six numbers");
  expect((await upToDate(page)).state).toBe("ready");
});

test("of an octree with more points than are shown, the coarser levels are read, and the page says so", async () => {
  served.set(
    "ranged/octree.copc.laz",
    new Uint8Array(readFileSync(join(import.meta.dirname, "fixtures/octree.copc.laz"))),
  );
  const page = await openReady("?src=ranged/octree.copc.laz&points=1100");
  expect((await upToDate(page)).total).toBe(1000);
  expect(await page.locator("#message p").textContent()).toContain(
    "Of its 3,000 points, the 1,000 points of its coarser levels are shown",
  );
});
