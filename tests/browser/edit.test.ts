// Selected points are kept, hidden and classified, and written as LAS with all that the file said.
import { spawnSync } from "node:child_process";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { root } from "../root.js";
import { at, clickPoint, everything, lonely, MIDDLE, openBall, positions, tool, visible } from "./ball.js";
import { classOf, colorOf, inMillimeters, intensityOf, las } from "./formats.js";
import { inNode, openReady, served, status, upToDate } from "./support.js";

const [X, Y, Z] = MIDDLE;
const VIEW = `&up=y&view=${[X, Y, Z + 9].join()}&target=${MIDDLE.join()}`;
const PYTHON = join(root, "target", "python", "bin", "python");
const hasLaspy = existsSync(PYTHON) && spawnSync(PYTHON, ["-c", "import laspy"]).status === 0;

const card = (page: Page) => page.locator("#select-card");
const press = (page: Page, name: string) => card(page).getByRole("button", { name, exact: true }).click();
const selected = (page: Page) => page.locator("#select-result").getAttribute("data-count");

/** Selects the points with a coordinate y of at least this number. */
async function selectAbove(page: Page, least: number): Promise<number[]> {
  if ((await tool(page, "Select").getAttribute("aria-pressed")) !== "true") await tool(page, "Select").click();
  await page.locator("#select-shape label", { hasText: "Range" }).click();
  await page.getByLabel("Least y of the box").fill(String(least));
  await press(page, "Select the points in the box");
  return everything.filter((i) => at(i)[1] >= least);
}

async function savedLas(page: Page): Promise<Buffer> {
  if ((await tool(page, "Export").getAttribute("aria-pressed")) !== "true") await tool(page, "Export").click();
  const coming = page.waitForEvent("download");
  await page.locator("#export-las").click();
  return readFileSync(await (await coming).path());
}

const total = async (page: Page, count: number) => {
  await page.locator(`#status[data-total="${count}"]`).waitFor({ state: "attached" });
  return upToDate(page);
};

test("only the selected points are kept, or they are hidden; the answer is that of the rest, and it can be undone", async () => {
  const page = await openBall();
  const before = await status(page);
  const upper = await selectAbove(page, Y + 0.5);
  expect(await selected(page)).toBe(String(upper.length));
  await press(page, "Keep these");
  const kept = await total(page, upper.length);
  expect(kept.viewpoint).toEqual(before.viewpoint);
  const part = Float64Array.from(upper.flatMap((i) => at(i)));
  const seen = await inNode(part, (cloud) => [...cloud.visibleFrom(kept.viewpoint, { looks: 3 }).indices]);
  expect(kept.visible).toBe(seen.length);

  // A pick tells the index in the file.
  const index = upper[seen[0]!]!;
  const [found] = await lonely(
    page,
    seen.map((i) => upper[i]!),
    upper,
  );
  await tool(page, "Pick").click();
  await clickPoint(page, found!);
  expect(await page.locator("#pick-result").textContent()).toContain(`index ${found!}`);
  expect(index).toBeGreaterThanOrEqual(0);

  await tool(page, "Select").click();
  await press(page, "Undo");
  const again = await total(page, 600);
  expect({ visible: again.visible, viewpoint: again.viewpoint }).toEqual({
    visible: before.visible,
    viewpoint: before.viewpoint,
  });
  expect(await card(page).getByRole("button", { name: "Undo" }).isVisible()).toBe(false);
  expect(new URL(page.url()).searchParams.get("src")).toBe("clouds/utm.ply");

  // Hidden twice, undone one after the other.
  await selectAbove(page, Y + 1);
  await press(page, "Hide these");
  const first = everything.filter((i) => at(i)[1] < Y + 1).length;
  await total(page, first);
  await selectAbove(page, Y);
  await press(page, "Invert");
  expect(await selected(page)).toBe(String(everything.filter((i) => at(i)[1] < Y).length));
  await press(page, "Hide these");
  await total(page, everything.filter((i) => at(i)[1] >= Y && at(i)[1] < Y + 1).length);
  await press(page, "Undo");
  await total(page, first);
  await press(page, "Undo");
  await total(page, 600);
});

const UTM = 'PROJCS["WGS 84 / UTM zone 32N",GEOGCS["WGS 84",UNIT["degree",0.0174532925199433]],UNIT["metre",1]]';

test.for([
  { format: 0, minor: 2 },
  { format: 3, minor: 2, extra: "deviation" },
  { format: 6, minor: 4 },
  { format: 8, minor: 4, extra: "deviation", wkt: UTM },
] as const)(
  "the visible points of a LAS file of format $format are the same bytes when they are written again",
  async (options) => {
    const source = Buffer.from(las(positions, options));
    served.set("clouds/again.las", source);
    const page = await openReady(`?src=clouds/again.las${VIEW}`);
    const seen = await visible(page);
    const file = await savedLas(page);
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

test("classes are set and undone, and LAS, written from PLY, has them and the coordinates", async () => {
  const page = await openBall();
  const upper = await selectAbove(page, Y + 0.5);
  await card(page).locator("select").selectOption("6");
  await press(page, "Set the class");
  expect(await page.locator("#color").inputValue()).toBe("classification");
  expect(await page.locator("#legend").textContent()).toContain(`building${upper.length}`);
  await card(page).locator("select").selectOption("2");
  await press(page, "Set the class");
  await press(page, "Undo");
  expect(await page.locator("#legend").textContent()).toContain(`building${upper.length}`);
  await press(page, "Invert");
  await press(page, "Invert");
  await tool(page, "Export").click();
  await page.locator("#export-what label", { hasText: "Selected" }).click();
  const file = await savedLas(page);
  expect(file.toString("latin1", 0, 4)).toBe("LASF");
  const [start, length, count] = [file.readUInt32LE(96), file.readUInt16LE(105), Number(file.readBigUInt64LE(247))];
  expect(count).toBe(upper.length);
  for (const [row, index] of upper.entries()) {
    const from = start + row * length;
    for (const [axis, value] of at(index).entries()) {
      const [scale, offset] = [file.readDoubleLE(131 + 8 * axis), file.readDoubleLE(155 + 8 * axis)];
      expect(Math.abs(file.readInt32LE(from + 4 * axis) * scale + offset - value)).toBeLessThanOrEqual(0.51 * scale);
    }
    expect(file[from + 16]).toBe(6);
  }
});

test.skipIf(!hasLaspy)("laspy reads the same points and columns from the LAS files of the page", async () => {
  for (const options of [
    { format: 3, minor: 2, extra: "deviation" },
    { format: 8, minor: 4, extra: "deviation", wkt: UTM },
    null,
  ] as const) {
    served.set("clouds/again.las", las(positions, options ?? {}));
    const page = options ? await openReady(`?src=clouds/again.las${VIEW}`) : await openBall();
    const seen = await visible(page);
    const path = join(tmpdir(), "hpr-written.las");
    writeFileSync(path, await savedLas(page));
    const names = options ? ["intensity", "classification", "return_number", "red", "deviation"] : [];
    const script = `import laspy,sys,json
l=laspy.read(sys.argv[1])
print(json.dumps([l.xyz.tolist()] + [[float(v) for v in l[name]] for name in sys.argv[2:]]))`;
    const { stdout, stderr } = spawnSync(PYTHON, ["-c", script, path, ...names], { encoding: "utf8" });
    expect(stderr).toBe("");
    const [xyz, ...columns] = JSON.parse(stdout) as [number[][], ...number[][]];
    expect(xyz.length).toBe(seen.length);
    const places = options ? inMillimeters(positions) : positions;
    for (const [row, index] of seen.entries()) {
      for (let axis = 0; axis < 3; axis++) expect(xyz[row]![axis]).toBeCloseTo(places[3 * index + axis]!, 7);
      const wanted = [intensityOf(index), classOf(index), 1, 257 * colorOf(index)[0], Math.fround(index / 7)];
      if (options) expect(columns.map((column) => column[row])).toEqual(wanted);
    }
  }
});
