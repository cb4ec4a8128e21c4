import { expect, test } from "vitest";
import { lengthText, roundLength } from "../../www/tools/information.js";
import { asciiPly, ball, georeferencedBall } from "./clouds.js";
import { las } from "./formats.js";
import { openReady, served, unfold } from "./support.js";

const UTM = 'PROJCS["WGS 84 / UTM zone 32N",GEOGCS["WGS 84",UNIT["degree",0.0174532925199433]],UNIT["metre",1]]';

type Page = Awaited<ReturnType<typeof openReady>>;

async function information(page: Page): Promise<Record<string, string>> {
  await unfold(page, "Information");
  await page.locator("#info span").first().waitFor();
  return page.locator("#info > span").evaluateAll((rows) =>
    Object.fromEntries(
      rows.map((row) => {
        const name = row.querySelector("b")!.textContent;
        return [name, row.textContent.slice(name.length).trim()];
      }),
    ),
  );
}

test("the length of the scale bar is 1, 2 or 5 times a power of ten, with a fitting unit", () => {
  expect([0.0123, 1, 1.99, 2, 4.9, 7, 10, 5e8].map(roundLength)).toEqual([0.01, 1, 1, 2, 2, 5, 10, 5e8]);
  const meter = { name: "m", meters: 1 };
  const foot = { name: "ft", meters: 0.3048 };
  expect([5000, 20, 0.5, 0.002, 0.0001].map((length) => lengthText(length, meter))).toEqual(
    ["5 km", "20 m", "50 cm", "2 mm", "0.1 mm"].map((text) => text.replace(" ", "\u00a0")),
  );
  expect(lengthText(5000, foot)).toBe("5,000\u00a0ft");
  expect(lengthText(0.05, null)).toBe("0.05\u00a0units");
  expect(lengthText(1, null)).toBe("1\u00a0unit");
});

test("the information of a LAS file: extents with its digits, spacing, coordinate system and columns", async () => {
  served.set("clouds/map.las", las(georeferencedBall(600), { wkt: UTM }));
  const page = await openReady("?src=clouds/map.las");
  const rows = await information(page);
  expect(rows).toMatchObject({ File: "map.las", Points: "600", Coordinates: "WGS 84 / UTM zone 32N" });
  expect(rows["x"]).toMatch(/^5123\d\d\.\d{3} to 5123\d\d\.\d{3}$/);
  expect(rows["Size"]).toMatch(/^[\d.]+ × [\d.]+ × [\d.]+\sm$/);
  expect(rows["Spacing"]).toMatch(/^0\.\d+\sm$/);
  expect(rows["classification"]).toBe("ground, high vegetation, building");
  expect(rows["intensity"]).toMatch(/^\d+ to \d+$/);
});

test("a file without a coordinate system says so, and its lengths have no unit", async () => {
  served.set("clouds/ball.ply", asciiPly(ball(600)));
  const page = await openReady("?src=clouds/ball.ply");
  const rows = await information(page);
  expect(rows).toMatchObject({ File: "ball.ply", Coordinates: "The file names no system" });
  expect(rows["Size"]).toMatch(/units$/);

  // Another cloud has other information.
  await page.locator("#sample").selectOption("bunny");
  await expect.poll(() => page.locator("#info").textContent()).toContain("File bunny");
});

test("the scale bar is as long as it says, follows the zoom, and is in the saved picture's marks", async () => {
  served.set("clouds/scale.las", las(georeferencedBall(600), { wkt: UTM }));
  const page = await openReady("?src=clouds/scale.las");
  const bar = page.locator("#marks .scale");
  const seen = async () => {
    const pixels = await bar.locator("path.over").evaluate((path: SVGPathElement) => path.getBBox().width);
    return { pixels, text: (await bar.locator("text").textContent())! };
  };
  const before = await seen();
  const [, length, unit] = /^([\d.]+)\s(m|cm)$/.exec(before.text)!;
  const meters = Number(length) * (unit === "m" ? 1 : 0.01);
  // The bar is measured at the distance of the middle of the cloud.
  const share = await page.evaluate(() => {
    const { viewpoint } = document.getElementById("status")!.dataset;
    return { at: viewpoint!.split(",").map(Number), height: document.getElementById("view")!.clientHeight };
  });
  const middle = [512_345.5, 5_403_210.25, 431.75];
  const distance = Math.hypot(...share.at.map((value, axis) => value - middle[axis]!));
  const expected = (share.height * meters) / (2 * distance * Math.tan(Math.PI / 8));
  expect(before.pixels / expected).toBeGreaterThan(0.97);
  expect(before.pixels / expected).toBeLessThan(1.03);
  await page.locator("#view").focus();
  for (let i = 0; i < 16; i++) await page.keyboard.press("+");
  await expect.poll(async () => (await seen()).text).not.toBe(before.text);
});
