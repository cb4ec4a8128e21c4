import { hiddenPointRemoval, init } from "hidden-point-removal";
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { openReady, PHONE } from "./support.js";

/** The points of the first picture, and which of them are drawn as seen. */
function drawn(page: Page): Promise<{ points: number[]; seen: number[] }> {
  return page
    .locator("#how svg")
    .first()
    .evaluate((svg) => {
      const dots = [...svg.querySelectorAll("circle:not(.eye)")];
      return {
        points: dots.flatMap((dot) => ["cx", "cy"].map((name) => Number(dot.getAttribute(name)))),
        seen: dots.flatMap((dot, i) => (dot.classList.contains("seen") ? [i] : [])),
      };
    });
}

const closed = async (page: Page) => {
  await page.addInitScript(() => {
    localStorage.removeItem("hidden-point-removal: tools");
  });
};

for (const [where, options] of [
  ["at 1000 pixels", {}],
  ["on a phone", PHONE],
] as const) {
  test(`${where}, the lesson shows what the package sees for each radius`, async () => {
    const page = await openReady("?sample=bunny", options, closed);
    const asked: string[] = [];
    page.on("request", (request) => asked.push(request.url()));
    await page.getByRole("button", { name: "How it works" }).click();
    const says = page.locator("#how [role=status]");
    await says.filter({ hasText: "About the automatic radius" }).waitFor();
    // It is loaded only now.
    expect(asked.some((address) => address.includes("/assets/how-"))).toBe(true);
    await init();
    const slider = page.locator("#how-radius");
    const counts: number[] = [];
    for (const exponent of [await slider.inputValue(), "3", "0.2"]) {
      await slider.fill(exponent);
      const { points, seen } = await drawn(page);
      const { indices } = hiddenPointRemoval(Float64Array.from(points), [0, 0], {
        dimension: 2,
        exponent: Number(exponent),
      });
      expect(seen).toEqual([...indices]);
      expect(await says.textContent()).toContain(`${seen.length} of ${points.length / 2} points`);
      counts.push(seen.length);
    }
    expect(await says.textContent()).toContain("Too small");
    const [usual, large, small] = counts as [number, number, number];
    expect(large).toBeGreaterThan(usual);
    expect(small).toBeLessThan(usual);
    await page.getByRole("button", { name: "Automatic radius" }).click();
    expect((await drawn(page)).seen).toHaveLength(usual);
    expect(await page.locator("#how").evaluate((dialog) => dialog.scrollWidth - dialog.clientWidth)).toBe(0);
    await page.keyboard.press("Escape");
    await expect.poll(() => page.locator("#how").count()).toBe(0);
  });
}
