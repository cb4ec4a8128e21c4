import { readFileSync } from "node:fs";
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { at, clickPoint, everything, openBall, tool, visible, within } from "./ball.js";
import { EVERY_PIXEL, openReady, picture, status, upToDate } from "./support.js";
import { differentPixels } from "./pixels.js";
import { addStyle } from "./site.js";

const COLOR = (index: number) => [index % 256, (7 * index) % 256, 255 - (index % 256)];

/** The ball with a color and an intensity for each point, like a scanner's file. */
function coloredPly(): Uint8Array {
  const head = ["ply", "format binary_little_endian 1.0", `element vertex ${everything.length}`];
  const properties = ["x", "y", "z"]
    .map((axis) => `property double ${axis}`)
    .concat(
      ["red", "green", "blue"].map((channel) => `property uchar ${channel}`),
      "property ushort intensity",
    );
  const body = Buffer.alloc(29 * everything.length);
  for (const index of everything) {
    for (const [axis, value] of at(index).entries()) body.writeDoubleLE(value, 29 * index + 8 * axis);
    body.set(COLOR(index), 29 * index + 24);
    body.writeUInt16LE(100 * index, 29 * index + 27);
  }
  return Buffer.concat([Buffer.from([...head, ...properties, "end_header", ""].join("\n")), body]);
}

/** The file that a click on this button of the export card saves. */
async function saved(page: Page, button: string): Promise<{ name: string; content: Buffer }> {
  const coming = page.waitForEvent("download");
  await page.locator("#export-card").getByRole("button", { name: button }).click();
  const download = await coming;
  return { name: download.suggestedFilename(), content: readFileSync(await download.path()) };
}

interface Ply {
  properties: string[];
  comments: string[];
  rows: number[][];
}

function readPly(file: Buffer): Ply {
  const end = file.indexOf("end_header\n") + 11;
  const lines = file.subarray(0, end).toString().split("\n");
  expect(lines.slice(0, 2)).toEqual(["ply", "format binary_little_endian 1.0"]);
  const properties = lines.filter((line) => line.startsWith("property ")).map((line) => line.slice(9));
  const count = Number(lines.find((line) => line.startsWith("element vertex "))!.slice(15));
  let offset = end;
  const next = (type: string) => {
    const bytes = { double: 8, float: 4, uint16: 2 }[type] ?? 1;
    offset += bytes;
    return bytes === 8
      ? file.readDoubleLE(offset - 8)
      : bytes === 4
        ? file.readFloatLE(offset - 4)
        : bytes === 2
          ? file.readUInt16LE(offset - 2)
          : file.readUInt8(offset - 1);
  };
  const rows = Array.from({ length: count }, () => properties.map((property) => next(property.split(" ")[0]!)));
  expect(offset).toBe(file.length);
  return { properties, comments: lines.filter((line) => line.startsWith("comment ")), rows };
}

test("the visible points saved as PLY and CSV equal the package's, with colors and attributes, in full precision", async () => {
  const page = await openBall({}, undefined, coloredPly());
  const seen = await visible(page);
  await tool(page, "Export").click();
  const ply = await saved(page, "PLY");
  expect(ply.name).toBe("utm-visible.ply");
  const { properties, comments, rows } = readPly(ply.content);
  expect(properties).toEqual([
    "double x",
    "double y",
    "double z",
    "uchar red",
    "uchar green",
    "uchar blue",
    "uint16 intensity",
  ]);
  expect(rows).toEqual(seen.map((index) => [...at(index), ...COLOR(index), 100 * index]));
  const { viewpoint } = await status(page);
  expect(comments).toEqual([
    `comment Visible points: ${seen.length} of 600`,
    `comment Seen from ${viewpoint.join(" ")}`,
    "comment 3 looks",
  ]);

  const csv = await saved(page, "CSV");
  expect(csv.content.toString()).toBe(
    ["index,x,y,z", ...seen.map((index) => [index, ...at(index)].join()), ""].join("\n"),
  );

  // The saved file opens as a cloud with the same number of points.
  const before = await status(page);
  await page.locator("#file").setInputFiles({ name: ply.name, mimeType: "", buffer: ply.content });
  await page.locator(`#status[data-total="${seen.length}"]`).waitFor();
  expect((await upToDate(page)).refilters).toBeGreaterThan(before.refilters);
});

test("a lasso takes only visible points unless it goes through, Shift adds, and the selection is saved", async () => {
  const page = await openBall();
  const seen = await visible(page);
  const canvas = (await page.locator("#view").boundingBox())!;
  const [x, y] = [canvas.x + canvas.width / 2, canvas.y + canvas.height / 2];
  const left = { left: x - 70.3, top: y - 70.3, right: x, bottom: y + 70.3 };
  const right = { ...left, left: x, right: x + 70.3 };
  const around = async (box: typeof left) => {
    await page.mouse.move(box.left, box.top);
    await page.mouse.down();
    await page.mouse.move(box.right, box.top);
    await page.mouse.move(box.right, box.bottom);
    await page.mouse.move(box.left, box.bottom);
    await page.mouse.up();
  };
  const indices = async () => {
    await tool(page, "Export").click();
    const file = await saved(page, "CSV");
    await tool(page, "Select").click();
    const rows = file.content.toString().trim().split("\n").slice(1);
    return { name: file.name, indices: rows.map((row) => Number.parseInt(row)) };
  };
  const before = await status(page);
  await tool(page, "Select").click();
  await around(left);
  expect(await indices()).toEqual({ name: "utm-selected.csv", indices: await within(page, seen, left) });
  await page.keyboard.down("Shift");
  await around(right);
  await page.keyboard.up("Shift");
  const both = await within(page, seen, { ...left, right: right.right });
  expect(await page.locator("#select-result").getAttribute("data-count")).toBe(String(both.length));
  expect(await indices()).toEqual({ name: "utm-selected.csv", indices: both });
  await page.getByLabel("Through the surface").check();
  await around(left);
  const through = await within(page, everything, left);
  expect(through.length).toBeGreaterThan((await within(page, seen, left)).length);
  expect((await indices()).indices).toEqual(through);
  // The camera stood still.
  expect((await status(page)).viewpoint).toEqual(before.viewpoint);
  await page.locator("#select-clear").click();
  expect(await indices()).toEqual({ name: "utm-visible.csv", indices: seen });
});

test("the picture is saved as it is on the screen, with its marks", async () => {
  const page = await openBall(EVERY_PIXEL);
  await tool(page, "Measure").click();
  const seen = await visible(page);
  const canvas = (await page.locator("#view").boundingBox())!;
  for (const shift of [-60, 60]) {
    // Looks for visible points in a box around this place.
    const places = await within(page, seen, {
      left: canvas.x + canvas.width / 2 + shift - 40,
      right: canvas.x + canvas.width / 2 + shift + 40,
      top: canvas.y + canvas.height / 2 - 40,
      bottom: canvas.y + canvas.height / 2 + 40,
    });
    await clickPoint(page, places[0]!);
  }
  expect(await page.locator("#marks .measure").count()).toBe(1);
  await tool(page, "Export").click();
  const png = await saved(page, "PNG");
  expect(png.name).toBe("utm-picture.png");
  await tool(page, "Export").click();
  await addStyle(page, "#tools, #drawer { visibility: hidden }");
  await page.locator("#view").blur();
  const shown = await picture(page);
  expect(await differentPixels(shown, png.content)).toBeLessThan(60);
  await addStyle(page, "#marks { visibility: hidden }");
  expect(await differentPixels(await picture(page), png.content)).toBeGreaterThan(200);
});

test("while the WebGL context is lost, no picture is saved and a message says so", async () => {
  const page = await openBall();
  const context = await page.evaluateHandle(() =>
    document.querySelector<HTMLCanvasElement>("#view")!.getContext("webgl2")!.getExtension("WEBGL_lose_context")!,
  );
  await context.evaluate((extension) => {
    extension.loseContext();
  });
  const message = page.locator("#message p");
  await expect.poll(() => message.textContent()).toMatch(/^The browser has taken the picture away/);
  await tool(page, "Export").click();
  await page.getByRole("button", { name: "PNG" }).click();
  await expect.poll(() => page.locator("#export-result").textContent()).toMatch(/taken the picture away/);
  await context.evaluate((extension) => {
    extension.restoreContext();
  });
  await expect.poll(() => message.isVisible()).toBe(false);
  expect((await saved(page, "PNG")).content.length).toBeGreaterThan(1000);
});

test("the copied link is the address, and there is none for a file of the user", async () => {
  const page = await openReady("?sample=dragon_res4", { permissions: ["clipboard-read", "clipboard-write"] });
  await tool(page, "Export").click();
  await page.getByRole("button", { name: "Copy link" }).click();
  await expect.poll(() => page.locator("#export-result").textContent()).toBe("The link is copied.");
  const link = await page.evaluate(() => navigator.clipboard.readText());
  expect(link).toBe(page.url());

  // A link cannot open a file on the user's device.
  await page
    .locator("#file")
    .setInputFiles({ name: "own.xyz", mimeType: "", buffer: Buffer.from("0 0 0\n1 0 0\n0 1 0\n0 0 1\n") });
  await page.locator('#status[data-total="4"]').waitFor();
  await page.getByRole("button", { name: "Copy link" }).click();
  await expect.poll(() => page.locator("#export-result").textContent()).toMatch(/^No link can open/);
  expect(await page.evaluate(() => navigator.clipboard.readText())).toBe(link);
});
