// A surveyor's files: coordinates of a map, their own decimals, units, and rows and columns with gaps.
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { clickPoint, lonely, MIDDLE, positions, tool, visible } from "./ball.js";
import { asciiPly, pcd } from "./clouds.js";
import { classOf, inMillimeters, intensityOf, las } from "./formats.js";
import { openReady, served, status, upToDate } from "./support.js";

const [X, Y, Z] = MIDDLE;
export const UTM = 'PROJCS["WGS 84 / UTM zone 32N",GEOGCS["WGS 84",UNIT["degree",0.0174532925199433]],UNIT["metre",1]]';

/** The ball as a LAS file of whole millimeters, seen from straight ahead. */
async function openLas(options: Parameters<typeof las>[1] = {}): Promise<Page> {
  served.set("clouds/map.las", las(positions, { wkt: UTM, ...options }));
  return openReady(`?src=clouds/map.las&up=y&view=${[X, Y, Z + 9].join()}&target=${MIDDLE.join()}`);
}

/** The names and the values in a card. */
async function rowsIn(page: Page, id: string): Promise<Record<string, string>> {
  const lines = await page
    .locator(`#${id} span`)
    .evaluateAll((spans) =>
      spans.map((span) => [span.firstElementChild!.textContent, span.lastChild!.textContent!.trim()]),
    );
  return Object.fromEntries(lines) as Record<string, string>;
}

test("a ply file with map coordinates stands upright, one without them does not change", async () => {
  served.set("clouds/map.ply", asciiPly(positions));
  served.set("clouds/object.ply", asciiPly(positions.map((value, i) => value - MIDDLE[i % 3]!)));
  const up = async (name: string) => {
    const page = await openReady(`?src=clouds/${name}.ply`);
    await upToDate(page);
    expect(new URL(page.url()).searchParams.has("up")).toBe(false);
    return page.locator("#up-axis input:checked").getAttribute("value");
  };
  expect(await up("map")).toBe("z");
  expect(await up("object")).toBe("y");
});

test("an organised PCD with gaps opens at once, and a message says how many places have no point", async () => {
  const width = 20;
  const values = Array.from({ length: width * width }, (_, i) =>
    i % 7 === 0 ? [NaN, NaN, NaN] : [(i % width) / 10 - 1, Math.floor(i / width) / 10 - 1, 2 + (i % 3) / 10],
  ).flat();
  const file = pcd(values, "binary");
  const text = Buffer.from(file)
    .toString("latin1")
    .replace(/WIDTH \d+/, `WIDTH ${width}`)
    .replace("HEIGHT 1", `HEIGHT ${width}`);
  served.set("clouds/depth.pcd", Buffer.from(text, "latin1"));
  const page = await openReady("?src=clouds/depth.pcd");
  const gaps = Math.ceil((width * width) / 7);
  expect((await status(page)).total).toBe(width * width - gaps);
  expect(await page.locator("#message p").textContent()).toBe(
    `${gaps} of the 400 places in its rows and columns have no point (NaN) and are left out.`,
  );
});

test("a picked point of a LAS file has the file's decimals and every attribute that says something", async () => {
  const page = await openLas({ format: 3, extra: "deviation" });
  const seen = await visible(page);
  const [index] = await lonely(page, seen, seen);
  await tool(page, "Pick").click();
  await clickPoint(page, index!);
  const place = inMillimeters(positions).subarray(3 * index!, 3 * index! + 3);
  // Some of these numbers have many more digits in binary.
  expect([...inMillimeters(positions)].some((value) => String(value).length > 13)).toBe(true);
  expect(await rowsIn(page, "pick-result")).toMatchObject({
    x: place[0]!.toFixed(3),
    y: place[1]!.toFixed(3),
    z: place[2]!.toFixed(3),
    index: String(index),
    intensity: String(intensityOf(index!)),
    classification: `${classOf(index!)} (${{ 2: "ground", 5: "high vegetation", 6: "building" }[classOf(index!)]})`,
    deviation: String(Number(Math.fround(index! / 7).toPrecision(7))),
    "number of returns": "1",
    red: String(257 * (index! % 256)),
  });
  // A column that is 0 everywhere says nothing.
  expect(Object.keys(await rowsIn(page, "pick-result"))).not.toContain("user data");
});

test("a text's digits come back in a pick, also of four-byte floats", async () => {
  const values = [0.1, 0.2, 0.3, 1.1, 0.7, 0.9, 0.4, 1.3, 0.5, -0.6, -0.3, 0.8];
  served.set("clouds/tenths.ply", asciiPly(values));
  const page = await openReady("?src=clouds/tenths.ply&view=0.1,0.2,6&target=0.1,0.2,0.3");
  await tool(page, "Pick").click();
  await page.locator("#view").press("Enter");
  expect(await rowsIn(page, "pick-result")).toMatchObject({ x: "0.1", y: "0.2", z: "0.3" });
});

test.for([
  {
    wkt: 'PROJCS["NAD83 / New York",GEOGCS["NAD83",UNIT["degree",0.01745]],UNIT["US survey foot",0.304800609601219]]',
    unit: "ft (US survey)",
  },
  { wkt: "nonsense", unit: "units" },
])("a measure has its horizontal part, its difference of heights and the unit: $unit", async ({ wkt, unit }) => {
  const page = await openLas({ wkt });
  const seen = await visible(page);
  const [a, b] = await lonely(page, seen, seen);
  await tool(page, "Measure").click();
  for (const index of [a!, b!]) await clickPoint(page, index);
  const all = inMillimeters(positions);
  const [dx, dy, dz] = [0, 1, 2].map((axis) => all[3 * b! + axis]! - all[3 * a! + axis]!) as [number, number, number];
  const digits = (value: number) => Math.max(2, 2 - Math.floor(Math.log10(Math.abs(value))));
  const text = (value: number) =>
    `${Number(unit === "units" ? value.toPrecision(6) : value.toFixed(digits(value)))}\u00a0${unit}`;
  expect(await rowsIn(page, "measure-result")).toEqual({
    Distance: text(Math.hypot(dx, dy, dz)),
    // The test looks along z, so y is up.
    Horizontal: text(Math.hypot(dx, dz)),
    "Height difference": text(dy),
  });
});
