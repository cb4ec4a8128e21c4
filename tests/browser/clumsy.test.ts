// Faults that an hour of clumsy and hostile use has found.
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { asciiPly, ball, georeferencedBall } from "./clouds.js";
import { choose } from "./files.js";
import { addressWritten, openPage, openReady, provoke, reached, served, status, upToDate } from "./support.js";

/** The page as a stranger finds it. */
const withoutTools = async (page: Page) => {
  await page.addInitScript(() => {
    localStorage.removeItem("hidden-point-removal: tools");
  });
};

test("a long refusal leaves the picture where it is, and the caption is about the cloud", async () => {
  const page = await openReady("?sample=bunny", {}, withoutTools);
  const before = await status(page);
  const caption = page.locator("#caption");
  const said = `1,839 points. ${before.visible} can be seen from here.`;
  await expect.poll(() => caption.textContent()).toBe(said);
  await choose(page, "broken.ply", new TextEncoder().encode(`ply\n${"no line of a header ".repeat(20)}\nend_header\n`));
  await reached(page, "error");
  // Longer than an answer to another view would take.
  await page.waitForTimeout(1000);
  expect(await status(page)).toEqual({ ...before, state: "error" });
  expect(await caption.textContent()).toBe(said);
});

test("a file from the device clears the address, and the ghosts of a frozen eye", async () => {
  const page = await openReady("?sample=bunny&exponent=2&label=5,ear", {}, withoutTools);
  await page.getByRole("button", { name: "Freeze and walk around" }).click();
  await upToDate(page);
  expect((await addressWritten(page)).get("hidden")).toBe("dimmed");
  await choose(page, "own.ply", asciiPly(ball(600)));
  await page.locator('#status[data-total="600"]').waitFor({ state: "attached" });
  await upToDate(page);
  expect(new URL(page.url()).search).toBe("");
  expect(await page.getByRole("radio", { name: "Hide", includeHidden: true }).isChecked()).toBe(true);
});

test("a page whose script cannot be loaded says so over the empty picture", async () => {
  provoke(/Failed to load resource|Failed to fetch dynamically imported module/);
  const page = await openPage("", {}, async (opened) => {
    await withoutTools(opened);
    await opened.route("**/assets/session-*.js", (route) => route.abort());
  });
  await expect.poll(() => page.locator("#caption").textContent()).toMatch(/could not be loaded; reload the page/);
});

test("the wheel zooms the picture also over the line that divides it", async () => {
  const page = await openReady("?sample=bunny&compare=0.5");
  const { viewpoint } = await status(page);
  await page.locator("#divider").hover();
  await page.mouse.wheel(0, -300);
  await expect.poll(async () => (await upToDate(page)).viewpoint).not.toEqual(viewpoint);
});

test("with the system's few colors, the words of a pressed button differ from its ground", async () => {
  const page = await openReady("?sample=bunny&compare=0.5", { forcedColors: "active" }, withoutTools);
  const [color, ground] = await page.locator("#compare").evaluate((button) => {
    const style = getComputedStyle(button);
    return [style.color, style.backgroundColor];
  });
  expect(color).not.toBe(ground);
});

test("Escape closes a dialog alone, and the message behind it stays", async () => {
  const page = await openReady("?sample=bunny&exponent=99", {}, withoutTools);
  await page.locator("#source .how").click();
  await page.locator("#how").waitFor();
  await page.keyboard.press("Escape");
  await expect.poll(() => page.locator("dialog[open]").count()).toBe(0);
  expect(await page.locator("#message").isVisible()).toBe(true);
});

test("a part that cannot be downloaded later is told without the browser's words", async () => {
  provoke(/Failed to load resource/);
  const page = await openReady("?sample=bunny", {}, async (opened) => {
    await withoutTools(opened);
    await opened.route("**/assets/how-*.js", (route) => route.abort());
  });
  await page.locator("#source .how").click();
  await expect
    .poll(() => page.locator("#message p").textContent())
    .toBe("The lesson could not be shown: a part of this page could not be downloaded; reload the page to try again.");
});

test("Unfreeze looks at the present cloud, and not at the place where another one was frozen", async () => {
  served.set("clouds/far.ply", asciiPly(georeferencedBall(600)));
  const page = await openReady("?src=clouds/far.ply", {}, withoutTools);
  const verb = (name: string) => page.getByRole("button", { name }).click();
  const placesWritten = async () => {
    const address = await addressWritten(page);
    return ["freeze", "view", "target"].filter((name) => address.has(name));
  };
  // Back to the last bit, or the address would have the view.
  await verb("Freeze and walk around");
  expect(await placesWritten()).toContain("freeze");
  await verb("Unfreeze");
  expect(await placesWritten()).toEqual([]);
  await verb("Freeze and walk around");
  await upToDate(page);
  await page.locator('#thumbnails [data-sample="room"]').click();
  await page.locator('#status[data-total="300000"]').waitFor({ state: "attached" });
  const { viewpoint } = await upToDate(page);
  await page.locator("#view").press("v");
  await verb("Unfreeze");
  await expect.poll(async () => (await upToDate(page)).viewpoint).toEqual(viewpoint);
  expect(await placesWritten()).toEqual([]);
});

test.for(["assets/session-*.js", "assets/living-room-*.js"])(
  "who clicks before %s is there sees a still picture, divided in the middle",
  async (late) => {
    const page = await openPage("", { reducedMotion: "no-preference" }, async (opened) => {
      await withoutTools(opened);
      await opened.route(`**/${late}`, async (route) => {
        await opened.locator("#walk").click();
        await route.continue();
      });
    });
    await reached(page, "ready");
    const { viewpoint } = await upToDate(page);
    await expect.poll(() => page.locator("#divider").getAttribute("aria-valuenow")).toBe("50");
    expect((await upToDate(page)).viewpoint).toEqual(viewpoint);
  },
);
