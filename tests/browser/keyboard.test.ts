import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { openReady, PHONE } from "./support.js";

interface Stop {
  name: string;
  /** The fault of the visible focus on this element, or `null`. */
  flaw: string | null;
}

/**
 * Returns the element with the focus, and checks that the focus is visible. The ring must have enough contrast
 * (WCAG 1.4.11: 3) and be around a visible element.
 */
async function stop(page: Page): Promise<Stop | null> {
  return page.evaluate(() => {
    const element = document.activeElement as HTMLElement | null;
    if (!element || element === document.body) return null;
    const name = nameOf(element);
    // A radio button shows its ring on its label, the divider on its handle.
    const ringed = element.closest<HTMLElement>(".segmented label") ?? element;
    const style = element.id === "divider" ? getComputedStyle(element, "::after") : getComputedStyle(ringed);
    const { left, right, top, bottom, width, height } = ringed.getBoundingClientRect();
    const flaws = [];
    if (style.outlineStyle === "none" || Number.parseFloat(style.outlineWidth) < 2) flaws.push("has no ring");
    if (left < -1 || top < -1 || right > innerWidth + 1 || bottom > innerHeight + 1) {
      flaws.push(`is out of sight (${Math.round(top)} to ${Math.round(bottom)})`);
    }
    // Other elements may cover a part of the element, but never all of it (WCAG 2.4.11).
    const shares = [0.1, 0.3, 0.5, 0.7, 0.9];
    const seen = shares.some((x) =>
      shares.some((y) => ringed.contains(document.elementFromPoint(left + x * width, top + y * height))),
    );
    if (!seen) flaws.push("is covered");
    // The background inside if the ring is drawn inwards, else the background around.
    const inwards = Number.parseFloat(style.outlineOffset) < 0;
    const ground = groundOf(inwards ? ringed : ringed.parentElement!);
    const ratio = contrast(style.outlineColor, ground);
    if (ratio < 3) flaws.push(`has a ring of contrast ${ratio.toFixed(1)}: ${style.outlineColor} on ${ground}`);
    return { name, flaw: flaws.length > 0 ? `${name} ${flaws.join(", ")}` : null };

    function nameOf(of: Element): string {
      const radio = of instanceof HTMLInputElement && of.type === "radio";
      return radio
        ? `radio ${of.name}`
        : `${of.tagName} ${of.id || (of as HTMLElement).ariaLabel || of.textContent.trim().slice(0, 30)}`;
    }
    function groundOf(from: Element): string {
      for (let at: Element | null = from; at; at = at.parentElement) {
        const { backgroundColor } = getComputedStyle(at);
        if (!backgroundColor.startsWith("rgba")) return backgroundColor;
      }
      return "rgb(255, 255, 255)";
    }
    function contrast(a: string, b: string): number {
      const [low, high] = [a, b]
        .map((css) =>
          css
            .match(/[\d.]+/g)!
            .slice(0, 3)
            .map((text) =>
              Number(text) <= 10.31 ? Number(text) / 3294.6 : ((Number(text) / 255 + 0.055) / 1.055) ** 2.4,
            ),
        )
        .map(([red, green, blue]) => 0.2126 * red! + 0.7152 * green! + 0.0722 * blue!)
        .sort((x, y) => x - y);
      return (high! + 0.05) / (low! + 0.05);
    }
  });
}

/** All visible elements that a mouse can use, by the names above. */
async function usable(page: Page): Promise<string[]> {
  return page.evaluate(() => {
    const all = [...document.querySelectorAll<HTMLElement>("a[href], button, input, select, summary, [tabindex]")];
    const found = all.filter(
      (element) => element.checkVisibility() && element.tabIndex >= 0 && !element.matches(":disabled"),
    );
    const names = found.map((element) =>
      element instanceof HTMLInputElement && element.type === "radio"
        ? `radio ${element.name}`
        : `${element.tagName} ${element.id || element.ariaLabel || element.textContent.trim().slice(0, 30)}`,
    );
    return [...new Set(names)];
  });
}

const WIDE = { viewport: { width: 1280, height: 800 } };
const SETTINGS = "?sample=dragon_res3&compare=0.3";

test.for([
  { ...WIDE, colorScheme: "dark" },
  { ...PHONE, colorScheme: "light" },
] as const)(
  "Tab reaches everything, the focus is always visible, and it can leave the page ($viewport.width px, $colorScheme)",
  async (options) => {
    const page = await openReady(SETTINGS, options);
    if (options.viewport.width < 760) await page.getByRole("button", { name: "More controls" }).click();
    await page.evaluate(() => {
      for (const section of document.querySelectorAll("details")) section.open = true;
      (document.activeElement as HTMLElement).blur();
    });
    await page.locator("#tool-bar").getByRole("button", { name: "Label" }).click();
    await page.locator("#view").press("Enter");
    // The label takes the focus when its point is found.
    await expect.poll(() => page.evaluate(() => document.activeElement?.id)).toBe("label-text");
    const expected = await usable(page);
    expect(expected.length).toBeGreaterThan(25);
    // From the beginning of the page.
    await page.evaluate(() => {
      const start = document.createElement("span");
      start.tabIndex = -1;
      document.body.prepend(start);
      start.focus();
      start.remove();
    });
    const stops: Stop[] = [];
    for (let i = 0; i < 2 * expected.length; i++) {
      await page.keyboard.press("Tab");
      const here = await stop(page);
      // Ends when the focus has left the page or is back at the first element.
      if (!here || here.name === stops[0]?.name) break;
      stops.push(here);
    }
    const names = stops.map(({ name }) => name);
    expect(
      expected.filter((name) => !names.includes(name)),
      "not reached",
    ).toEqual([]);
    expect(stops.length, "visited").toBeLessThan(2 * expected.length);
    expect(stops.flatMap(({ flaw }) => flaw ?? [])).toEqual([]);
    // Shift+Tab goes back to the last element.
    await page.keyboard.press("Shift+Tab");
    expect((await stop(page))?.name).toBe(names.at(-1));
  },
);

test("while a cloud is loading nothing moves for users who prefer reduced motion", async () => {
  const page = await openReady("?sample=dragon_res4", { reducedMotion: "reduce" });
  await page.route("**/samples/bunny.bin", () => undefined);
  await page.locator("#sample").selectOption("bunny");
  await page.getByRole("button", { name: "Stop loading" }).waitFor();
  const picture = () => page.screenshot({ clip: { x: 0, y: 0, width: 1000, height: 80 } });
  const before = await picture();
  await page.waitForTimeout(300);
  expect(before.equals(await picture())).toBe(true);
});
