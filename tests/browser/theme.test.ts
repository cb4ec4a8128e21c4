import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { type ThemeName, THEMES } from "../../www/view/theme.ts";
import { at, clickPoint, everything, openBall, tool } from "./ball.js";
import { EVERY_PIXEL, openPage, openReady, picture, settled, status, unfold } from "./support.js";

/** Points that are surely visible: they bulge most towards the viewer. */
const NEAREST = everything.toSorted((i, j) => at(j)[2] - at(i)[2]).slice(0, 2);

const OTHER: Record<ThemeName, ThemeName> = { dark: "light", light: "dark" };

/** The colors of the page: the background in the corner of the canvas, and the colors of the page's parts. */
async function colors(page: Page): Promise<Record<string, string>> {
  const corner = await pixel(page, await picture(page), 4, 4);
  const own = await page.evaluate(() => {
    const hex = (css: string) =>
      `#${css
        .match(/\d+/g)!
        .map((value) => Number(value).toString(16).padStart(2, "0"))
        .join("")}`;
    return {
      body: hex(getComputedStyle(document.body).backgroundColor),
      scheme: getComputedStyle(document.documentElement).colorScheme,
      browser: hex(document.querySelector<HTMLMetaElement>('meta[name="theme-color"]')!.content),
      panel: hex(getComputedStyle(document.getElementById("panel")!).backgroundColor),
    };
  });
  return { corner, ...own };
}

async function pixel(page: Page, png: Buffer, x: number, y: number): Promise<string> {
  return page.evaluate(
    async ([data, left, top]) => {
      const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob());
      const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d")!;
      context.drawImage(bitmap, 0, 0);
      const [r, g, b] = context.getImageData(left, top, 1, 1).data;
      return `#${[r, g, b].map((value) => value!.toString(16).padStart(2, "0")).join("")}`;
    },
    [png.toString("base64"), x, y] as const,
  );
}

function expectTheme(seen: Record<string, string>, name: ThemeName): void {
  const { background } = THEMES[name];
  expect(seen).toMatchObject({ corner: background, body: background, scheme: name, browser: seen["panel"] });
}

test("the page and its canvas follow the system's theme; a chosen theme stays", async () => {
  const name = "dark";
  const page = await openReady("?sample=bunny", { colorScheme: name });
  expectTheme(await colors(page), name);
  await page.emulateMedia({ colorScheme: OTHER[name] });
  expectTheme(await colors(page), OTHER[name]);
  // A chosen theme stays, is in the address, and asks no new question.
  await settled(page);
  const { refilters } = await status(page);
  await unfold(page, "Look");
  await page.getByRole("group", { name: "Theme" }).getByRole("radio", { name: "Dark" }).check();
  expectTheme(await colors(page), name);
  await page.waitForFunction((theme) => new URLSearchParams(location.search).get("theme") === theme, name);
  expect((await status(page)).refilters).toBe(refilters);
  await page.getByRole("group", { name: "Theme" }).getByRole("radio", { name: "System" }).check();
  expectTheme(await colors(page), OTHER[name]);
  await page.waitForFunction(() => !location.search.includes("theme="));
});

test("the address's theme is set before anything is drawn, even before the script has loaded", async () => {
  const page = await openPage("?sample=bunny", { colorScheme: "dark" });
  await page.route("**/assets/index-*.js", () => undefined);
  await page.goto(`${page.url().split("?")[0]!}?sample=bunny&theme=light`, { waitUntil: "commit" });
  await page.locator("#status").waitFor();
  const [r, g, b] = [1, 3, 5].map((at) => Number.parseInt(THEMES.light.background.slice(at, at + 2), 16));
  // The style sheet may still be on its way.
  await expect
    .poll(() => page.evaluate(() => getComputedStyle(document.body).backgroundColor))
    .toBe(`rgb(${r}, ${g}, ${b})`);
});

test("points, hidden points and the saved picture's marks have the theme's colors", async () => {
  const drawn: Record<string, string[]> = {};
  for (const name of ["dark", "light"] as const) {
    const page = await openBall({ colorScheme: name, ...EVERY_PIXEL });
    await unfold(page, "Look");
    await page.locator("#color").selectOption("plain");
    await tool(page, "Measure").click();
    for (const index of NEAREST) await clickPoint(page, index);
    const download = page.waitForEvent("download");
    await tool(page, "Export").click();
    await page.getByRole("button", { name: "Picture, PNG" }).click();
    const stream = await (await download).createReadStream();
    const parts: Buffer[] = [];
    for await (const part of stream) parts.push(part as Buffer);
    drawn[name] = await commonColors(page, Buffer.concat(parts));
    const mark = { dark: "#e7b562", light: "#8a5a0b" };
    expect(drawn[name], name).toContain(THEMES[name].background);
    expect(drawn[name], name).toContain(mark[name]);
    expect(drawn[name], name).not.toContain(mark[OTHER[name]]);
    expect(drawn[name], name).toContain(THEMES[name].plain);
  }
});

/** All colors of more than three pixels. */
async function commonColors(page: Page, png: Buffer): Promise<string[]> {
  return page.evaluate(async (data) => {
    const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob());
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d")!;
    context.drawImage(bitmap, 0, 0);
    const { data: pixels } = context.getImageData(0, 0, bitmap.width, bitmap.height);
    const counts = new Map<number, number>();
    for (let i = 0; i < pixels.length; i += 4) {
      const color = (pixels[i]! << 16) | (pixels[i + 1]! << 8) | pixels[i + 2]!;
      counts.set(color, (counts.get(color) ?? 0) + 1);
    }
    return [...counts].filter(([, count]) => count > 3).map(([color]) => `#${color.toString(16).padStart(6, "0")}`);
  }, png.toString("base64"));
}
