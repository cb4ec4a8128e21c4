import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { type ThemeName, THEMES } from "../../www/view/theme.ts";
import { at, clickPoint, everything, openBall, tool } from "./ball.js";
import { EVERY_PIXEL, openPage, openReady, picture, settled, status, unfold } from "./support.js";
import { pixelsOf } from "./pixels.js";

/** Points that are surely visible: they bulge most towards the viewer. */
const NEAREST = everything.toSorted((i, j) => at(j)[2] - at(i)[2]).slice(0, 2);

const OTHER: Record<ThemeName, ThemeName> = { dark: "light", light: "dark" };

const colorAt = (data: Uint8Array, at: number) => `#${Buffer.from(data.subarray(at, at + 3)).toString("hex")}`;

/** The colors of the page: the background in the corner of the canvas, and the colors of the page's parts. */
async function colors(page: Page): Promise<Record<string, string>> {
  const { data, width } = await pixelsOf(await picture(page));
  const corner = colorAt(data, 4 * (4 * width + 4));
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
    drawn[name] = await commonColors(Buffer.concat(parts));
    const mark = { dark: "#e7b562", light: "#8a5a0b" };
    expect(drawn[name], name).toContain(THEMES[name].background);
    expect(drawn[name], name).toContain(mark[name]);
    expect(drawn[name], name).not.toContain(mark[OTHER[name]]);
    expect(drawn[name], name).toContain(THEMES[name].plain);
  }
});

/** All colors of more than three pixels. */
async function commonColors(png: Buffer): Promise<string[]> {
  const { data } = await pixelsOf(png);
  const counts = new Map<string, number>();
  for (let i = 0; i < data.length; i += 4) counts.set(colorAt(data, i), (counts.get(colorAt(data, i)) ?? 0) + 1);
  return [...counts].filter(([, count]) => count > 3).map(([color]) => color);
}
