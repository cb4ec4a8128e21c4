import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { addStyle } from "./site.js";
import { ball, georeferencedBall, text } from "./clouds.js";
import { choose } from "./files.js";
import { attributedPcd, colorOf, glb, inMillimeters, las, table } from "./formats.js";
import { answered, openReady, picture, reached, served, unfold, upToDate } from "./support.js";
import { differentPixels, pixelsOf } from "./pixels.js";

const COUNT = 600;
const near = ball(COUNT);
const far = inMillimeters(georeferencedBall(COUNT));

async function open(page: Page, name: string, content: Uint8Array): Promise<void> {
  const before = await upToDate(page);
  await choose(page, name, content);
  await answered(page, before);
}

const choices = (page: Page) => page.locator("#color option").allTextContents();

test("a cloud can be colored by intensity, class and other attributes", async () => {
  // Without looks each file has one answer.
  const page = await openReady("?sample=bunny&looks=0");
  expect(await choices(page)).toEqual(["Two tones", "One color", "Height"]);
  for (const [name, content, extra] of [
    [
      "extra.las",
      las(far, { minor: 4, format: 7, extra: "height_above_ground" }),
      ["Intensity", "Classification", "Height above ground"],
    ],
    ["table.csv", table(near), ["Intensity", "Class"]],
    ["cloud.pcd", attributedPcd(near), ["Intensity", "Class"]],
    ["colors.glb", glb(near, { colors: true }), []],
  ] as const) {
    await open(page, name, content);
    expect(await choices(page), name).toEqual(["Its own colors", "One color", "Height", ...extra]);
    if (extra.length === 0) continue;

    await unfold(page, "Look");
    await page.locator("#color").selectOption({ label: extra[1] });
    const entries = await page.locator("#legend li").allInnerTexts();
    const words = entries.map((entry) => entry.split(/\s*\n\s*/));
    const named = extra[1] === "Classification";
    expect(words, name).toEqual([
      [named ? "ground" : "2", "200"],
      [named ? "high vegetation" : "5", "200"],
      [named ? "building" : "6", "200"],
    ]);
    await unfold(page, "Look");
    await page.locator("#color").selectOption({ label: "Intensity" });
    const ends = (await page.locator("#legend").innerText())
      .split(/\s*\n\s*/)
      .map((number) => Number(number.replace(",", "")));
    // From the 1st to the 99th percentile of 0 … 4095.
    expect(ends[0], name).toBeGreaterThanOrEqual(0);
    expect(ends[0], name).toBeLessThan(100);
    expect(ends[1], name).toBeGreaterThan(4000);
    expect(ends[1], name).toBeLessThanOrEqual(4095);
  }
});

/** The amounts of red, green and blue in a picture, above its background. */
async function mean(page: Page): Promise<[number, number, number]> {
  const { data } = await pixelsOf(await picture(page));
  const sum: [number, number, number] = [0, 0, 0];
  for (let i = 0; i < data.length; i += 4) {
    if (Math.max(data[i]!, data[i + 1]!, data[i + 2]!) < 40) continue;
    sum.forEach((before, channel) => (sum[channel] = before + data[i + channel]!));
  }
  return sum;
}

test("a file's own colors are drawn as they are, also 8-bit colors in 16 bits, and other choices look different", async () => {
  const page = await openReady("?sample=bunny&looks=0", { colorScheme: "dark" });
  // All points are red, so the picture is red.
  await addStyle(page, "#tools, #drawer, #signs { visibility: hidden }");
  const red = text([...near].map((value, i) => `${value}${i % 3 === 2 ? " 250 20 30\n" : " "}`).join(""));
  await open(page, "red.xyz", red);
  const [r, g, b] = await mean(page);
  expect(r).toBeGreaterThan(6 * g);
  expect(r).toBeGreaterThan(6 * b);
  const own = await picture(page);
  for (const label of ["One color", "Height"]) {
    await unfold(page, "Look");
    await page.locator("#color").selectOption({ label });
    expect(await differentPixels(own, await picture(page)), label).toBeGreaterThan(500);
  }
  await page.locator("#color").selectOption({ label: "Its own colors" });
  expect(await differentPixels(own, await picture(page))).toBeLessThan(20);

  await open(page, "wide.las", las(far));
  const wide = await picture(page);
  await open(page, "small.las", las(far, { smallColors: true }));
  expect(await differentPixels(wide, await picture(page))).toBeLessThan(20);
  await open(page, "white.las", las(far, { format: 0 }));
  expect(await differentPixels(wide, await picture(page))).toBeGreaterThan(500);
  expect(colorOf(1)).toEqual([1, 2, 254]);
});

test("the address holds the choice of colors, and a message names a choice that is not possible", async () => {
  served.set("usual.las", las(far));
  const page = await openReady("?src=usual.las&color=intensity");
  expect(await page.locator("#color").inputValue()).toBe("intensity");
  await unfold(page, "Look");
  await page.locator("#color").selectOption("classification");
  await page.waitForFunction(() => new URL(location.href).searchParams.get("color") === "classification");
  await page.reload();
  await reached(page, "ready");
  expect(await page.locator("#color").inputValue()).toBe("classification");
  expect(await page.locator("#legend li").count()).toBe(3);

  // The next cloud has no classes. It comes in its own colors, without a message.
  await open(page, "plain.xyz", text("0 0 0\n1 0 0\n0 1 0\n0 0 1\n"));
  expect(await page.locator("#color").inputValue()).toBe("own");
  expect(await page.locator("#legend").isVisible()).toBe(false);
  expect(await page.locator("#message").isVisible()).toBe(false);

  const asked = await openReady("?src=usual.las&color=mood");
  expect(await asked.locator("#message p").textContent()).toBe(
    "The cloud has no “mood” to color by, so it has its usual colors.",
  );
});

test("the sample tile has classes, intensity and map coordinates; heights are in the file's own coordinates, along the chosen up side", async () => {
  const page = await openReady("?sample=bunny&looks=0");
  const before = await upToDate(page);
  await page.locator("#sample").selectOption("tile");
  const now = await answered(page, before);
  expect(now.total).toBeGreaterThan(200_000);
  expect(now.viewpoint[1]).toBeGreaterThan(5_400_000);
  expect(await choices(page)).toEqual(expect.arrayContaining(["Intensity", "Classification"]));
  await unfold(page, "Look");
  await page.locator("#color").selectOption("classification");
  expect(await page.locator("#legend").innerText()).toContain("high vegetation");
  const colors = await page
    .locator("#legend .swatch")
    .evaluateAll((all) => all.map((swatch) => getComputedStyle(swatch).backgroundColor.match(/\d+/g)!.map(Number)));
  for (const [i, a] of colors.entries()) {
    for (const b of colors.slice(i + 1)) {
      expect(Math.hypot(...a.map((channel, k) => channel - b[k]!)), `${a.join()} and ${b.join()}`).toBeGreaterThan(45);
    }
  }
  expect(await page.locator(`#thumbnails [aria-pressed="true"]`).textContent()).toBe("Map tile");
  await expect.poll(() => new URL(page.url()).searchParams.get("sample")).toBe("tile");

  await page.locator("#color").selectOption("height");
  const [low, high] = (await page.locator("#legend").innerText())
    .split(/\s*\n\s*/)
    .map((number) => Number(number.replaceAll(",", "")));
  expect(low).toBeGreaterThan(420);
  expect(high).toBeLessThan(490);
  expect(high! - low!).toBeGreaterThan(20);
  await page.locator("#up-axis").getByRole("radio", { name: "Y", exact: true }).check();
  await page.waitForFunction(() => document.querySelector("#legend .low")!.textContent.startsWith("5,403,0"));
});

test("loading can be stopped, and the previous cloud stays", async () => {
  const page = await openReady("?sample=bunny&points=300000");
  const before = await upToDate(page);
  // This many points take long enough to be stopped. Few of them are drawn meanwhile.
  const content = las(far, { format: 0, claimed: 120_000_000 });
  await page.evaluate(
    (bytes) => {
      const points = Uint8Array.from(bytes.slice(227));
      const many = new Blob(Array.from({ length: 1000 }, () => points));
      const data = new DataTransfer();
      data.items.add(
        new File([Uint8Array.from(bytes.slice(0, 227)), ...Array.from({ length: 200 }, () => many)], "large.las"),
      );
      document.getElementById("view")!.dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true }));
    },
    [...content],
  );
  await page.getByRole("button", { name: "Stop loading" }).click();
  const after = await reached(page, "error");
  expect(after).toEqual({ ...before, state: "error", sentence: "large.las was not opened: its loading was stopped." });
  expect(await page.locator("#progress").isVisible()).toBe(false);
  await page.keyboard.press("Escape");
  await page.locator("#view").focus();
  await page.keyboard.press("ArrowLeft");
  const moved = await answered(page, after);
  expect(moved).toMatchObject({ state: "ready", total: 1839 });

  // The address of the previous cloud stays, too. A chosen sample has changed it before its loading is stopped.
  await page.route("**/tile.bin", () => undefined);
  await page.locator("#sample").selectOption("tile");
  await expect.poll(() => page.url()).toContain("?sample=tile");
  await page.getByRole("button", { name: "Stop loading" }).click();
  await reached(page, "error");
  expect(page.url()).toContain("?sample=bunny");
  await page.getByRole("radio", { name: "Ghost" }).check();
  await expect.poll(() => page.url()).toContain("hidden=dimmed");
});
