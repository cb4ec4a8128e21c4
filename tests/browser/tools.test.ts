import { expect, test } from "vitest";
import { at, clickPoint, everything, lonely, MIDDLE, openBall, place, tool, visible } from "./ball.js";
import { measured } from "../../www/tools/make.js";
import { drag, openReady, settled, status, upToDate, unfold } from "./support.js";

const [X, Y, Z] = MIDDLE;

test("a click tells a visible point's index and its place in full precision", async () => {
  const page = await openBall();
  const seen = await visible(page);
  const [first, second] = await lonely(page, seen, seen);
  await tool(page, "Pick").click();
  const result = page.locator("#pick-result");
  for (const index of [first!, second!]) {
    await clickPoint(page, index);
    expect(await result.locator("span").allTextContents()).toEqual([
      ...["x", "y", "z"].map((axis, i) => `${axis} ${at(index)[i]!}`),
      `index ${index}`,
    ]);
    const { x, y } = await place(page, index);
    const ring = (await page.locator("#marks .ring").boundingBox())!;
    expect(ring.x + ring.width / 2).toBeCloseTo(x, 0);
    expect(ring.y + ring.height / 2).toBeCloseTo(y, 0);
  }
  // A drag turns the camera and picks nothing. The ring moves with its point.
  const before = (await page.locator("#marks .ring").boundingBox())!;
  await drag(page, 40, 0);
  expect((await settled(page)).viewpoint).not.toEqual([X, Y, Z + 9]);
  expect(await result.getAttribute("data-index")).toBe(String(second));
  expect((await page.locator("#marks .ring").boundingBox())!.x).not.toBeCloseTo(before.x, 0);

  await page.mouse.click(40, 40);
  expect(await result.textContent()).toBe("No visible point there.");
  expect(await page.locator("#marks .ring").count()).toBe(0);
});

test("if points are drawn large, a click on any part of a disc counts", async () => {
  const page = await openReady("?sample=bunny&size=1.4");
  await tool(page, "Pick").click();
  const canvas = (await page.locator("#view").boundingBox())!;
  for (const x of [0.44, 0.48, 0.52, 0.56]) {
    for (const y of [0.5, 0.55, 0.6]) {
      await page.mouse.click(canvas.x + x * canvas.width, canvas.y + y * canvas.height);
      expect(await page.locator("#pick-result").getAttribute("data-index"), `${x}, ${y}`).toMatch(/^\d+$/);
    }
  }
});

test("hidden points are picked only through the surface", async () => {
  const page = await openBall();
  // No visible point is drawn over these points.
  await unfold(page, "Look");
  await page.getByLabel("Point size").fill("0.1");
  const seen = new Set(await visible(page));
  const hidden = everything.filter((i) => !seen.has(i));
  const [index] = await lonely(page, hidden, everything);
  await tool(page, "Pick").click();
  await clickPoint(page, index!);
  const result = page.locator("#pick-result");
  expect(await result.getAttribute("data-index")).toBe(null);
  await page.getByLabel("Through the surface").check();
  await clickPoint(page, index!);
  expect(await result.getAttribute("data-index")).toBe(String(index));
  expect(await page.locator("#marks .ring.hidden").count()).toBe(1);
});

test("by keyboard: P opens the tool, Enter picks the middle, Escape ends first the point and then the tool", async () => {
  const target = 300;
  const [x, y, z] = at(target);
  // The camera is straight outside of this point, so the point is visible.
  const from = [x + 3 * (x - X), y + 3 * (y - Y), z + 3 * (z - Z)];
  const page = await openBall({}, from);
  await page.locator("#view").focus();
  await page.keyboard.press("p");
  expect(await tool(page, "Pick").getAttribute("aria-pressed")).toBe("true");
  await page.keyboard.press("Enter");
  expect(await page.locator("#pick-result").getAttribute("data-index")).toBe(String(target));
  await page.keyboard.press("Escape");
  expect(await page.locator("#marks .ring").count()).toBe(0);
  expect(await tool(page, "Pick").getAttribute("aria-pressed")).toBe("true");
  await page.keyboard.press("Escape");
  expect(await tool(page, "Pick").getAttribute("aria-pressed")).toBe("false");
  expect(await page.locator("#tool-card").isVisible()).toBe(false);
});

test("two clicks measure a distance in the file's units, any number of times", async () => {
  const page = await openBall();
  const seen = await visible(page);
  const [a, b, c] = await lonely(page, seen, seen);
  const distance = (i: number, j: number) => Math.hypot(...at(i).map((value, axis) => value - at(j)[axis]!));
  await tool(page, "Measure").click();
  const result = page.locator("#measure-result");
  for (const index of [a!, b!]) await clickPoint(page, index);
  expect(Number(await result.getAttribute("data-distance"))).toBe(distance(a!, b!));
  for (const index of [a!, c!]) await clickPoint(page, index);
  const texts = [distance(a!, b!), distance(a!, c!)].map((value) => `${Number(value.toPrecision(6))}\u00a0units`);
  expect(await page.locator("#marks .measure text").allTextContents()).toEqual(texts);
  // The line goes from point to point.
  const ends = await page
    .locator("#marks .measure line")
    .last()
    .evaluate((line) => ["x1", "y1", "x2", "y2"].map((name) => Number(line.getAttribute(name))));
  const [from, to] = [await place(page, a!), await place(page, c!)];
  for (const [i, value] of [from.x, from.y, to.x, to.y].entries()) expect(ends[i]).toBeCloseTo(value, 0);

  // Escape gives up the third distance.
  await clickPoint(page, b!);
  expect(await page.locator("#marks .ring").count()).toBe(1);
  await page.keyboard.press("Escape");
  expect(await page.locator("#marks .ring").count()).toBe(0);
  expect(await page.locator("#marks .measure").count()).toBe(2);
  await page.getByRole("button", { name: "Undo" }).click();
  expect(await page.locator("#marks .measure text").allTextContents()).toEqual(texts.slice(0, 1));
  expect(Number(await result.getAttribute("data-distance"))).toBe(distance(a!, b!));
  await page.getByRole("button", { name: "Clear all" }).click();
  expect(await page.locator("#marks .measure").count()).toBe(0);
});

test("lengths have the digits of their unit", () => {
  const meters = { name: "m", meters: 1 };
  const said = ([11.5812, 0.0123456, 1234.5678, 0] as const).map((value) => measured(value, meters));
  expect(said).toEqual(["11.58\u00a0m", "0.0123\u00a0m", "1234.57\u00a0m", "0\u00a0m"]);
  expect(measured(11.5812, { name: "mm", meters: 0.001 })).toBe("11.6\u00a0mm");
  expect(measured(11.5812, null)).toBe("11.5812\u00a0units");
});

test("the keys of the tools work wherever the focus is, and open the drawer", async () => {
  const page = await openReady("?sample=bunny");
  await page.getByRole("button", { name: "Close tools" }).click();
  for (const [key, name] of [
    ["p", "Pick"],
    ["m", "Measure"],
    ["l", "Label"],
    ["s", "Select"],
    ["t", "Stations"],
    ["e", "Export"],
  ] as const) {
    await page.keyboard.press(key);
    expect(await tool(page, name).getAttribute("aria-pressed"), key).toBe("true");
  }
  await page.keyboard.press("c");
  expect(await page.locator("#divider").isVisible()).toBe(true);
});

test("a label is shown as long as its point is visible", async () => {
  const page = await openBall();
  const seen = await visible(page);
  const [index] = await lonely(page, seen, seen);
  await tool(page, "Label").click();
  await clickPoint(page, index!);
  // The field has the focus, so its letters do not act as keys.
  await page.keyboard.type("Chimney <b> crest?");
  await page.keyboard.press("Enter");
  const label = page.locator("#marks .note");
  expect(await label.locator("text").textContent()).toBe("Chimney <b> crest?");
  expect(await label.isVisible()).toBe(true);
  // The camera goes to the other side of the ball and back.
  const around = (await page.locator("#view").boundingBox())!.height / 2;
  await drag(page, around, 0);
  await settled(page);
  expect((await visible(page)).includes(index!)).toBe(false);
  expect(await label.isVisible()).toBe(false);
  await drag(page, -around, 0);
  await settled(page);
  expect(await label.isVisible()).toBe(true);
  await page.getByRole("button", { name: "Remove the label Chimney <b> crest?" }).click();
  expect(await label.count()).toBe(0);

  // Escape in the field gives the label up.
  await clickPoint(page, index!);
  await page.keyboard.type("never");
  await page.keyboard.press("Escape");
  expect(await page.getByLabel("Text of the label").isVisible()).toBe(false);
  expect(await page.locator("#marks .note, #marks .ring").count()).toBe(0);
});

test("a double click goes to the point: it gets into the middle of the picture, at half its distance", async () => {
  const page = await openBall();
  const before = await status(page);
  const seen = await visible(page);
  const [index] = await lonely(page, seen, everything);
  const { x, y } = await place(page, index!);
  await page.mouse.dblclick(x, y);
  await expect.poll(() => new URL(page.url()).searchParams.get("target")).not.toBe(MIDDLE.join());
  const now = await upToDate(page);
  const target = new URL(page.url()).searchParams.get("target")!.split(",").map(Number);
  const far = (a: readonly number[], b: readonly number[]) => Math.hypot(...a.map((value, axis) => value - b[axis]!));
  expect(far(target, at(index!))).toBeLessThan(1e-3);
  expect(far(now.viewpoint, at(index!)) / far(before.viewpoint, at(index!))).toBeCloseTo(0.5, 3);
});
