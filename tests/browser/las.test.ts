// The visible points of a LAS file are written as LAS with all that the file said. command-las.test.ts has more formats, and
// the fuzzer `foreign` asks laspy.
import { readFileSync } from "node:fs";
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { MIDDLE, positions, tool, visible } from "./ball.js";
import { las } from "./formats.js";
import { openReady, served, upToDate } from "./support.js";

const [X, Y, Z] = MIDDLE;
const VIEW = `&up=y&view=${[X, Y, Z + 9].join()}&target=${MIDDLE.join()}`;

/** The path of the file that the page saves. */
async function savedLas(page: Page): Promise<string> {
  if ((await tool(page, "Export").getAttribute("aria-pressed")) !== "true") await tool(page, "Export").click();
  const coming = page.waitForEvent("download");
  await page.locator("#export-las").click();
  return (await coming).path();
}

const total = async (page: Page, count: number) => {
  await page.locator(`#status[data-total="${count}"]`).waitFor({ state: "attached" });
  return upToDate(page);
};

const UTM = 'PROJCS["WGS 84 / UTM zone 32N",GEOGCS["WGS 84",UNIT["degree",0.0174532925199433]],UNIT["metre",1]]';

test.for([
  { format: 3, minor: 2, extra: "deviation" },
  { format: 8, minor: 4, extra: "deviation", wkt: UTM },
] as const)(
  "the visible points of a LAS file of format $format are the same bytes when they are written again",
  async (options) => {
    const source = Buffer.from(las(positions, options));
    served.set("clouds/again.las", source);
    const page = await openReady(`?src=clouds/again.las${VIEW}`);
    const seen = await visible(page);
    const file = readFileSync(await savedLas(page));
    const rows = (bytes: Buffer) => {
      const [start, length] = [bytes.readUInt32LE(96), bytes.readUInt16LE(105)];
      return Array.from({ length: (bytes.length - start) / length }, (_, i) =>
        bytes.subarray(start + i * length, start + (i + 1) * length).toString("hex"),
      );
    };
    const all = rows(source);
    expect(rows(file)).toEqual(seen.map((i) => all[i]));
    expect(file.subarray(131, 179)).toEqual(source.subarray(131, 179));
    expect(file.includes(UTM)).toBe("wkt" in options);

    // The page reads the file again. Bounds in the header that do not suit the points would be a message.
    await page.locator("#file").setInputFiles({ name: "again.las", mimeType: "", buffer: file });
    await total(page, seen.length);
    expect(await page.locator("#message").isVisible()).toBe(false);
  },
);
