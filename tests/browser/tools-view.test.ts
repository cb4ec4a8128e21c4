import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { at, openBall, place, tool } from "./ball.js";
import { drag, openReady, PHONE, picture, settled, status, upToDate } from "./support.js";
import { differentPixels } from "./pixels.js";

/** Where the divider is, in pixels from the left. */
async function dividerAt(page: Page): Promise<number> {
  const { x, width } = (await page.locator("#divider").boundingBox())!;
  return x + width / 2;
}

/** The pixels a little to the left and to the right of a place in the picture. */
async function halves(page: Page, at: number): Promise<[Buffer, Buffer]> {
  await picture(page);
  const { width } = (await page.locator("#view").boundingBox())!;
  const clip = (x: number, w: number) => page.screenshot({ clip: { x, y: 60, width: w, height: 500 } });
  return [await clip(0, at - 20), await clip(at + 20, width - at - 20)];
}

test("the divider shows all points to its left and visible ones to its right, by mouse and by keys", async () => {
  const page = await openReady("?sample=dragon_res3&size=0.4");
  const before = await settled(page);
  const divider = page.getByRole("slider", { name: /^Divider/ });
  expect(await divider.isVisible()).toBe(false);
  const x = 620;
  const plain = await halves(page, x);
  await tool(page, "Compare").click();
  expect(await dividerAt(page)).toBeLessThan(x);
  const note = page.locator("#compare-note span");
  for (const where of ["from here", "from the eye", "from here"]) {
    await expect.poll(() => note.allTextContents()).toEqual(["All points", `Seen ${where}`]);
    expect(await divider.getAttribute("aria-valuetext")).toMatch(`seen ${where} on the right`);
    await page.locator("#view").press("v");
  }
  await page.locator("#view").press("v");

  await divider.hover();
  await page.mouse.down();
  await page.mouse.move(x, 300, { steps: 4 });
  await page.mouse.up();
  expect(await dividerAt(page)).toBeCloseTo(x, 0);
  const divided = await halves(page, x);
  expect(await differentPixels(plain[0], divided[0])).toBeGreaterThan(2000);
  expect(await differentPixels(plain[1], divided[1])).toBe(0);

  await divider.focus();
  const value = async () => Number(await divider.getAttribute("aria-valuenow"));
  const first = await value();
  await page.keyboard.press("ArrowRight");
  expect(await value()).toBe(first + 2);
  await page.keyboard.press("End");
  expect(await value()).toBe(100);
  await page.keyboard.press("Home");
  expect(await value()).toBe(0);
  // Only visible points are left.
  expect(await differentPixels(plain[1], (await halves(page, x))[1])).toBe(0);
  expect(await status(page)).toEqual(before);

  await page.locator("#view").focus();
  await page.keyboard.press("c");
  expect(await divider.isVisible()).toBe(false);
});

test("the address says where the picture is divided, and it stays divided", async () => {
  const asked = await openReady("?sample=dragon_res4&compare=0.3");
  expect(await asked.locator("#divider").isVisible()).toBe(true);
  await drag(asked, 60, 0);
  await settled(asked);
  expect(await asked.locator("#divider").getAttribute("aria-valuenow")).toBe("30");
  await expect.poll(() => asked.url()).toContain("compare=0.3");
});

test("the question mark opens the sheet with all keys; it keeps the focus and gives it back", async () => {
  const page = await openReady("?sample=dragon_res4");
  await page.locator("#view").focus();
  await page.keyboard.press("?");
  const sheet = page.getByRole("dialog", { name: "Mouse, touch and keys" });
  expect(await sheet.isVisible()).toBe(true);
  for (const key of ["P", "M", "L", "C", "E", "H", "R", "?", "Esc"]) {
    expect(await sheet.locator("kbd").allTextContents()).toContain(key);
  }
  for (let i = 0; i < 5; i++) {
    await page.keyboard.press("Tab");
    expect(
      await page.evaluate(
        () =>
          document.activeElement === document.body || document.getElementById("keys")!.contains(document.activeElement),
      ),
    ).toBe(true);
  }
  await page.keyboard.press("Escape");
  expect(await sheet.isVisible()).toBe(false);
  expect(await page.evaluate(() => document.activeElement?.id)).toBe("view");
  // If the sheet does not fit, it opens scrolled to its top.
  await page.setViewportSize({ width: 320, height: 640 });
  await page.locator("#view").press("?");
  expect(
    await sheet.evaluate(({ scrollTop, scrollHeight, clientHeight }) => [scrollTop, scrollHeight > clientHeight]),
  ).toEqual([0, true]);
  const end = async (): Promise<number> => {
    await page.keyboard.press("End");
    return sheet.evaluate(({ scrollTop }) => scrollTop);
  };
  // A busy browser may lose a key that comes before it has laid out the sheet.
  await expect.poll(end).toBeGreaterThan(0);
  await page.getByRole("button", { name: "Close", exact: true }).click();
  expect(await sheet.isVisible()).toBe(false);
});

test.for([{ viewport: { width: 761, height: 600 } }, { ...PHONE, viewport: { width: 320, height: 600 } }])(
  "every tool has its place and covers no other ($viewport.width px)",
  async (options) => {
    const page = await openReady("?sample=dragon_res4", options);
    expect(await tool(page, "Stations").isVisible()).toBe(true);
    await tool(page, "Compare").click();
    for (const name of ["Pick", "Measure", "Label", "Export"]) {
      await tool(page, name).click();
      const flaws = await page.evaluate(() => {
        // A card may be scrolled. Only its part in the picture can cover something.
        const boxOf = (element: Element) => {
          const { left, right, top, bottom, width, height } = element.getBoundingClientRect();
          const card = element.closest("#tool-card");
          if (!card || card === element) return { left, right, top, bottom, width, height };
          const frame = card.getBoundingClientRect();
          const [low, high] = [Math.max(top, frame.top), Math.min(bottom, frame.bottom)];
          return { left, right, top: low, bottom: Math.max(low, high), width, height };
        };
        // On a phone the tools may be under the canvas.
        const [canvas, stage] = ["view", "stage"].map((id) => boxOf(document.getElementById(id)!));
        const shown = [
          ...document.querySelectorAll(
            "#tool-bar button, #tool-card button, #tool-card label, #tool-card output, #compare-note span",
          ),
        ].filter((element) => element.checkVisibility() && element.textContent !== "");
        const found: string[] = [];
        for (const [i, a] of shown.entries()) {
          const box = boxOf(a);
          const place = (a.closest("#tools") ? stage : canvas)!;
          if (box.left < place.left || box.right > place.right || box.bottom > place.bottom || box.top < place.top) {
            found.push(`${a.textContent} leaves its place`);
          }
          if (a.matches("#tool-bar button") && (box.width < 44 || box.height < 44)) {
            found.push(`${a.textContent} is too small`);
          }
          if (a.scrollWidth > a.clientWidth + 1 && a.matches("button")) found.push(`${a.textContent} is cut off`);
          for (const b of shown.slice(i + 1)) {
            const other = boxOf(b);
            const over =
              Math.min(box.right, other.right) - Math.max(box.left, other.left) > 1.5 &&
              Math.min(box.bottom, other.bottom) - Math.max(box.top, other.top) > 1.5;
            if (over) found.push(`${a.textContent} lies over ${b.textContent}`);
          }
        }
        return found;
      });
      expect(flaws, name).toEqual([]);
    }
  },
);

test("on a phone held upright, no card covers the cloud, and the cloud stays when a card says something else", async () => {
  const page = await openReady("?sample=bunny", PHONE);
  const boxes = () =>
    page.evaluate(() => {
      const [view, card] = ["view", "tool-card"].map((id) => document.getElementById(id)!.getBoundingClientRect());
      return { height: view!.height, isUnder: card!.top >= view!.bottom };
    });
  await tool(page, "Pick").tap();
  const { height, isUnder } = await boxes();
  expect(isUnder).toBe(true);
  expect(height).toBeGreaterThan(300);
  for (const name of ["Pick", "Measure", "Label", "Stations"]) {
    if (name !== "Pick") await tool(page, name).tap();
    await page.locator("#view").press("Enter");
    expect(await boxes(), name).toEqual({ height, isUnder });
  }
  // The cross for keyboards is in the middle of the picture.
  const cross = await page.locator("#stage").evaluate((stage) => getComputedStyle(stage, "::after").top);
  expect(Number.parseFloat(cross)).toBeCloseTo(height / 2 - 10, 0);
  await tool(page, "Stations").tap();
  expect((await boxes()).height).toBeGreaterThan(500);
});

test("a finger picks and labels; a long label stays in the picture, and its Remove button can be pressed", async () => {
  const page = await openBall(PHONE);
  await tool(page, "Pick").tap();
  // The point that bulges most towards the viewer is surely visible.
  const nearest = Array.from({ length: 600 }, (_, i) => i).reduce((best, i) => (at(i)[2] > at(best)[2] ? i : best), 0);
  const { x, y } = await place(page, nearest);
  await page.touchscreen.tap(x, y);
  await expect.poll(() => page.locator("#pick-result").getAttribute("data-index")).toBe(String(nearest));

  await tool(page, "Label").tap();
  await page.touchscreen.tap(x, y);
  const words = "A chimney of the old brickworks that was built, torn down and then built again.";
  await page.getByLabel("Text of the label").fill(words);
  await page.keyboard.press("Enter");
  const text = page.locator("#marks .note text");
  expect(await text.textContent()).toMatch(/^A chimney .*…$/);
  const box = (await text.boundingBox())!;
  expect(box.x).toBeGreaterThanOrEqual(0);
  expect(box.x + box.width).toBeLessThanOrEqual(PHONE.viewport.width);
  expect(await page.locator("#label-list span").textContent()).toBe(words);
  const remove = (await page.locator("#label-list button").boundingBox())!;
  expect(remove.width).toBeGreaterThan(60);
  expect(remove.height).toBe(44);
});

test("a label is measured once, however often the camera moves", async () => {
  const page = await openBall();
  await page.evaluate(() => {
    const counted = globalThis as unknown as { measured: number };
    counted.measured = 0;
    // oxlint-disable-next-line typescript/unbound-method
    const measure = SVGTextContentElement.prototype.getSubStringLength;
    SVGTextContentElement.prototype.getSubStringLength = function (from, count) {
      counted.measured++;
      return measure.call(this, from, count);
    };
  });
  const measured = () => page.evaluate(() => (globalThis as unknown as { measured: number }).measured);
  await tool(page, "Label").click();
  await page.locator("#view").press("Enter");
  await page.getByLabel("Text of the label").fill("Chimney");
  await page.keyboard.press("Enter");
  const first = await measured();
  expect(first).toBeGreaterThan(0);
  for (let i = 0; i < 4; i++) await page.locator("#view").press("ArrowLeft");
  await upToDate(page);
  expect(await measured()).toBe(first);
});
