// Several files at once: one cloud.
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import type { LoadedCloud } from "../../www/cloud/cloud.js";
import { merged } from "../../www/loaders/several.js";
import { asciiPly, ball, georeferencedBall } from "./clouds.js";
import { dropped } from "./files.js";
import { las } from "./formats.js";
import { answered, openReady, status, unfold } from "./support.js";

const UTM = 'PROJCS["WGS 84 / UTM zone 32N",GEOGCS["WGS 84",UNIT["degree",0.0174532925199433]],UNIT["metre",1]]';
const BALL = georeferencedBall(600);
const EAST = BALL.map((value, i) => (i % 3 === 0 ? value + 10 : value));

async function choose(page: Page, files: Record<string, Uint8Array | string>): Promise<void> {
  const payload = Object.entries(files).map(([name, content]) => ({
    name,
    mimeType: "",
    buffer: Buffer.from(content),
  }));
  await page.locator("#file").setInputFiles(payload);
}

test("a file that is far away from the others or cannot be read is named, and is not named as open", async () => {
  const page = await openReady("?sample=bunny");
  await choose(page, {
    "near.ply": asciiPly(ball(300)),
    "far.ply": asciiPly(ball(300).map((value, i) => (i % 3 === 0 ? value + 5_000_000 : value))),
    "torn.ply": "ply",
  });
  await page.locator('#status[data-total="300"]').waitFor();
  const message = await page.locator("#message p").textContent();
  expect(message).toMatch(/far\.ply lies 5,000,000 units away from near\.ply and is left out; open it alone\./);
  expect(message).toMatch(/torn\.ply/);
  expect(await page.locator("#panel .credit").textContent()).toContain("near.ply");
});

test("coordinates of several files do not change by a bit, and each point knows its file", () => {
  const one: LoadedCloud = {
    positions: Float32Array.of(0.1, 0.2, 0.3, 1, 2, 3),
    colors: Uint8Array.of(1, 2, 3, 4, 5, 6),
    attributes: [{ name: "class", kind: "category", values: Uint8Array.of(2, 5), labels: { 2: "ground" } }],
    fields: [
      { name: "class", values: Uint8Array.of(2, 5), labels: { 2: "ground" } },
      { name: "only here", values: Uint8Array.of(1, 1) },
      // Colors with more than a byte are columns, too.
      { name: "red", values: Uint16Array.of(256, 1024) },
      { name: "flags", values: Uint8Array.of(7) },
      { name: "time", values: Float32Array.of(0.5) },
    ],
  };
  const two: LoadedCloud = {
    positions: Float64Array.of(500000.0001, 5400000.0003, 7),
    colors: null,
    fields: [
      { name: "time", values: Float64Array.of(0.1) },
      { name: "class", values: Uint16Array.of(600) },
      { name: "flags", values: Uint8Array.of(7) },
    ],
  };
  const all = merged([
    { name: "one.ply", cloud: one },
    { name: "two.las", cloud: two },
  ]);
  expect(all.positions).toEqual(
    Float64Array.of(...Float32Array.of(0.1, 0.2, 0.3, 1, 2, 3), 500000.0001, 5400000.0003, 7),
  );
  expect(all.colors).toBe(null);
  expect(all.fields).toEqual([
    { name: "file", values: Uint8Array.of(0, 0, 1), labels: { 0: "one.ply", 1: "two.las" } },
    { name: "class", values: Float64Array.of(2, 5, 600), labels: { 2: "ground" } },
    // A number that all points share stays one number.
    { name: "flags", values: Uint8Array.of(7) },
    { name: "time", values: Float64Array.of(0.5, 0.5, 0.1) },
  ]);
  expect(all.attributes!.map(({ name, kind }) => [name, kind])).toEqual([
    ["file", "category"],
    ["class", "category"],
  ]);
  const notes = all.notes!.join(" ");
  expect(notes).toContain("Columns that not every file has are left out: only here and colors.");
});

test("files of one grid stay on it, and different coordinate systems are named", () => {
  const facts = (name: string, offset: number) => ({
    decimals: [2, 2, 3] as [number, number, number],
    crs: { name, unit: { name: "m", meters: 1 }, heightUnit: null, isAngular: false },
    las: {
      head: new Uint8Array(),
      format: 6,
      scale: [0.01, 0.01, 0.001] as const,
      offset: [offset, 0, 0] as const,
      records: [],
      extras: [],
    },
  });
  const part = (name: string, crs: string, offset: number) => ({
    name,
    cloud: { positions: Float64Array.of(1, 2, 3, 4, 5, 6), colors: null, facts: facts(crs, offset) },
  });
  const same = merged([part("a.las", "UTM 32", 5), part("b.las", "UTM 32", 5)]);
  expect(same.facts).toEqual(facts("UTM 32", 5));
  expect(same.notes).toEqual([]);
  const other = merged([part("a.las", "UTM 32", 5), part("b.las", "UTM 33", 6)]);
  expect(other.facts).toEqual({ decimals: [2, 2, 3] });
  expect(other.notes).toEqual([
    "The files do not name one coordinate system (a.las: UTM 32; b.las: UTM 33). Their coordinates are shown as they are.",
  ]);
});

test("several chosen files are one cloud; a broken one is named, and the others are shown", async () => {
  const page = await openReady("?sample=bunny");
  const before = await status(page);
  await choose(page, {
    "west.las": las(BALL, { wkt: UTM }),
    "broken.ply": "ply\nformat",
    "east.las": las(EAST, { wkt: UTM }),
  });
  expect(await answered(page, before)).toMatchObject({ state: "ready", total: 1200 });
  const message = (await page.locator("#message p").textContent())!;
  expect(message).toContain("broken.ply");
  expect(message).not.toContain("west.las");
  expect(await page.locator("#panel .credit").textContent()).toContain("west.las and east.las");
  await unfold(page, "Information");
  const info = page.locator("#info");
  await expect.poll(() => info.textContent()).toContain("WGS 84 / UTM zone 32N");
  const xs = [...BALL, ...EAST].filter((_, i) => i % 3 === 0);
  const [low, high] = [Math.min(...xs), Math.max(...xs)];
  expect(await info.textContent()).toContain(`${low.toFixed(3)} to ${high.toFixed(3)}`);
  expect(await info.textContent()).toContain("file west.las, east.lasred");
  await unfold(page, "Look");
  await page.locator("#color").selectOption({ label: "File" });
  await expect
    .poll(() => page.locator("#legend li").allTextContents())
    .toEqual([expect.stringContaining("west.las"), expect.stringContaining("east.las")]);
});

test("dropped files are one cloud; if none can be read, each is named and the cloud before stays", async () => {
  const page = await openReady("?sample=bunny");
  const before = await status(page);
  await dropped(page, (data) => {
    for (const name of ["one.xyz", "two.xyz"]) data.items.add(new File(["1 2 3\n4 5 6\n7 8 9.5\n"], name));
  });
  expect(await answered(page, before)).toMatchObject({ total: 6 });
  await dropped(page, (data) => {
    for (const name of ["three.xyz", "four.xyz"]) data.items.add(new File([""], name));
  });
  await expect.poll(() => page.locator("#message p").textContent()).toBe("three.xyz is empty. four.xyz is empty.");
  expect(await status(page)).toMatchObject({ state: "error", total: 6 });
});

test("of more points than the limit an even share of all files is shown", async () => {
  const page = await openReady("?sample=bunny&points=500");
  const before = await status(page);
  await choose(page, { "a.ply": asciiPly(ball(400)), "b.ply": asciiPly(ball(420)) });
  expect(await answered(page, before)).toMatchObject({ total: 410 });
  expect(await page.locator("#message p").textContent()).toContain("one in 2 is shown");
  expect(await page.locator("#up-axis input:checked").inputValue()).toBe("y");
});
