import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { openPage, openReady, PHONE, reached, refiltered, settled, status, unfold } from "./support.js";

/** Visible controls and texts that overlap, are cut off at the side, or have no name. */
async function flaws(page: Page): Promise<string[]> {
  return page.evaluate(() => {
    const shown = [
      ...document.querySelectorAll<HTMLElement>(
        "#view, #status, #panel button, #panel select, #panel legend, #panel output, .slider > label, .slider input, .segmented label, summary, #panel h2, .note, #message",
      ),
    ]
      .filter((element) => element.checkVisibility())
      .map((element) => ({
        element,
        box: element.getBoundingClientRect(),
        name: `${element.tagName} ${element.id || element.textContent.trim().slice(0, 24)}`,
      }));
    const found: string[] = [];
    for (const [i, a] of shown.entries()) {
      if (a.box.left < -0.5 || a.box.right > innerWidth + 0.5) found.push(`${a.name} reaches out of the page`);
      if (
        a.element.scrollWidth > a.element.clientWidth + 1 &&
        a.element.clientWidth > 0 &&
        a.element.tagName === "BUTTON"
      ) {
        found.push(`${a.name} is cut off`);
      }
      for (const b of shown.slice(i + 1)) {
        if (
          a.element.contains(b.element) ||
          b.element.contains(a.element) ||
          (a.element.id === "view" && b.element.id === "message")
        ) {
          continue;
        }
        // A scrolling sheet may lie under the fixed bar.
        const over =
          Math.min(a.box.right, b.box.right) - Math.max(a.box.left, b.box.left) > 1.5 &&
          Math.min(a.box.bottom, b.box.bottom) - Math.max(a.box.top, b.box.top) > 1.5;
        if (over) found.push(`${a.name} lies over ${b.name}`);
      }
    }
    if (document.documentElement.scrollWidth > innerWidth) found.push("the page scrolls sideways");
    for (const control of document.querySelectorAll<HTMLInputElement>("input, select")) {
      if (!control.labels?.length && !control.ariaLabel) found.push(`${control.id} has no label`);
    }
    return found;
  });
}

/** The picture takes its place in the next frame. */
const expectNoFlaws = (page: Page, message = "") => expect.poll(() => flaws(page), { message }).toEqual([]);

/** Unfolds every section of the panel, or folds all. */
const foldAll = (page: Page, isOpen: boolean) =>
  page.evaluate((open) => {
    document.getElementById("panel")!.classList.toggle("open", open);
    for (const section of document.querySelectorAll("details")) section.open = open;
  }, isOpen);

test("folded and unfolded, at 1280, 1000 and 761 px nothing overlaps and every control has a label", async () => {
  const page = await openReady("?sample=dragon_res4&color=height", { viewport: { width: 1280, height: 800 } });
  for (const width of [1280, 1000, 761]) {
    await page.setViewportSize({ width, height: 800 });
    for (const isOpen of [false, true]) {
      await foldAll(page, isOpen);
      await expectNoFlaws(page, `${width} px`);
    }
    // The slider and its button are in one row.
    const [slider, automatic] = await Promise.all(
      ["#exponent", "#radius-auto"].map((id) => page.locator(id).boundingBox()),
    );
    expect(automatic!.x).toBeGreaterThan(slider!.x + slider!.width);
  }
});

test("on a phone the panel is a bar that opens upwards, nothing overlaps, and one finger orbits", async () => {
  const page = await openReady("?sample=dragon_res4", PHONE);
  await expectNoFlaws(page);
  const view = page.locator("#view");
  expect((await view.boundingBox())!.height).toBeGreaterThan(500);
  expect(await page.getByLabel("Sample", { exact: true }).isVisible()).toBe(false);

  const toggle = page.getByRole("button", { name: "More controls" });
  await toggle.tap();
  await expectNoFlaws(page);
  expect(await page.getByLabel("Sample", { exact: true }).isVisible()).toBe(true);
  expect((await view.boundingBox())!.height).toBeGreaterThan(150);
  await page.getByRole("button", { name: "Fewer controls" }).tap();
  expect(await page.getByLabel("Sample", { exact: true }).isVisible()).toBe(false);

  // One finger orbits.
  const before = await status(page);
  const touch = await page.context().newCDPSession(page);
  const at = (x: number, y: number) => ({ touchPoints: [{ x, y }] });
  await touch.send("Input.dispatchTouchEvent", { type: "touchStart", ...at(200, 300) });
  for (let step = 1; step <= 6; step++) {
    await touch.send("Input.dispatchTouchEvent", { type: "touchMove", ...at(200 - 15 * step, 300) });
  }
  await touch.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
  expect((await refiltered(page, before)).viewpoint).not.toEqual(before.viewpoint);
});

test("a message fits a phone", async () => {
  const page = await openReady("?sample=unicorn", PHONE);
  expect(await page.locator("#message").isVisible()).toBe(true);
  await expectNoFlaws(page);
});

test.for([
  { name: "a phone held sideways", options: { ...PHONE, viewport: { width: 844, height: 390 } }, text: 16 },
  { name: "text of twice the size", options: { viewport: { width: 1280, height: 800 } }, text: 32 },
  {
    name: "everything of twice the size",
    options: { viewport: { width: 640, height: 400 }, deviceScaleFactor: 2 },
    text: 16,
  },
  {
    name: "the system's own colors",
    options: { viewport: { width: 1280, height: 800 }, forcedColors: "active" },
    text: 16,
  },
] as const)("with $name nothing overlaps or is cut off", async ({ options, text }) => {
  const page = await openPage("?sample=bunny", options);
  await (await page.context().newCDPSession(page)).send("Page.setFontSizes", { fontSizes: { standard: text } });
  await reached(page, "ready");
  expect(await page.evaluate(() => Number.parseFloat(getComputedStyle(document.documentElement).fontSize))).toBe(
    0.9375 * text,
  );
  await page.locator("#tools").waitFor();
  for (const open of [false, true]) {
    await foldAll(page, open);
    await expectNoFlaws(page);
  }
  // The cloud keeps enough space, and its tools stay within it.
  await page.evaluate(() => {
    document.getElementById("panel")!.classList.remove("open");
  });
  const view = (await page.locator("#view").boundingBox())!;
  const bar = (await page.locator("#tool-bar").boundingBox())!;
  expect(bar.y).toBeGreaterThan(view.y + 0.4 * view.height);
  expect(bar.x + bar.width).toBeLessThanOrEqual(view.x + view.width);
  await page.locator("#tool-export").click();
  expect(
    await page.locator("#tool-card").evaluate(({ scrollWidth, clientWidth }) => scrollWidth - clientWidth),
  ).toBeLessThanOrEqual(0);
});

test("every control is at least 44 pixels large for fingers, and covers no other", async () => {
  const page = await openReady("?sample=bunny&color=height", PHONE);
  await foldAll(page, true);
  await expectNoFlaws(page);
  const small = await page.evaluate(() => {
    const all = [
      ...document.querySelectorAll<HTMLElement>(
        "button, select, summary, .segmented label, input[type=range], #through-choice",
      ),
    ].filter((element) => element.checkVisibility());
    return all.flatMap((element) => {
      const { width, height } = element.getBoundingClientRect();
      return Math.min(width, height) < 43.9 ? `${element.id || element.textContent}: ${width} × ${height}` : [];
    });
  });
  expect(small).toEqual([]);
});

test("without WebGL a plain sentence says so", async () => {
  const page = await openPage("?sample=dragon_res4");
  await page.addInitScript(() => {
    HTMLCanvasElement.prototype.getContext = () => null;
  });
  await page.reload();
  expect((await reached(page, "error")).sentence).toMatch(/WebGL 2, which this browser does not offer/);
});

test("with the system's own colors the chosen options are visible", async () => {
  const page = await openReady("?sample=dragon_res4", { forcedColors: "active" });
  const background = (text: string) =>
    page
      .locator("#hidden-points label", { hasText: text })
      .evaluate((label) => getComputedStyle(label).backgroundColor);
  expect(await background("Hide")).not.toBe(await background("Ghost"));
  const compare = page.locator("#tool-compare");
  const color = () => compare.evaluate((button) => getComputedStyle(button).backgroundColor);
  const before = await color();
  await compare.click();
  expect(await color()).not.toBe(before);
  // All pressed buttons have the same color.
  await unfold(page, "Advanced");
  await page.locator("#tool-pick").click();
  const pressed = await page
    .locator('button[aria-pressed="true"]:not(#thumbnails *)')
    .evaluateAll((buttons) =>
      buttons
        .filter((button) => button.checkVisibility())
        .map((button) => [button.textContent.trim(), getComputedStyle(button).backgroundColor]),
    );
  expect(pressed.map(([name]) => name)).toEqual(expect.arrayContaining(["Pick", "Automatic", "Compare"]));
  expect(new Set(pressed.map(([, background]) => background)).size).toBe(1);
});

test("a narrower window still shows the whole cloud, at once and after a reset", async () => {
  const page = await openReady("?sample=dragon_res4");
  const wide = await status(page);
  await page.setViewportSize({ width: 420, height: 800 });
  const narrow = await refiltered(page, wide);
  expect(Math.hypot(...narrow.viewpoint)).toBeGreaterThan(1.2 * Math.hypot(...wide.viewpoint));
  await page.locator("#view").press("ArrowLeft");
  const moved = await refiltered(page, narrow);
  await page.setViewportSize({ width: 1000, height: 700 });
  expect((await settled(page)).viewpoint).toEqual(moved.viewpoint);
  await page.getByRole("button", { name: "Reset view" }).click();
  expect((await refiltered(page, moved)).viewpoint).toEqual(wide.viewpoint);
});
