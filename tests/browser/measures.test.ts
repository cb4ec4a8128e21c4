// Areas and profiles between clicked points, and files that the page does not read.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { readCloud } from "hidden-point-removal/files";
import { expect, test } from "vitest";
import { at, clickPoint, everything, lonely, openBall, tool, visible } from "./ball.js";
import { inNode, openReady, reached, settled } from "./support.js";

const text = (value: number, unit: string) => `${Number(value.toPrecision(6))}\u00a0${unit}`;

test("an area is measured between corners: the polygon's own and the horizontal one, and its perimeter", async () => {
  const page = await openBall();
  const seen = await visible(page);
  const corners = (await lonely(page, seen, seen)).slice(0, 3);
  await tool(page, "Measure").click();
  await page.locator("#measure-what label", { hasText: "Area" }).click();
  await expect.poll(() => page.locator("#measure-result").textContent()).toBe("Click the corners.");
  for (const index of corners) await clickPoint(page, index);
  const [a, b, c] = corners.map((corner) => [...at(corner)]) as [number[], number[], number[]];
  const [u, v] = [b, c].map((corner) => corner.map((value, k) => value - a[k]!)) as [number[], number[]];
  const cross = [0, 1, 2].map((k) => u[(k + 1) % 3]! * v[(k + 2) % 3]! - u[(k + 2) % 3]! * v[(k + 1) % 3]!);
  const length = (p: number[], q: number[]) => Math.hypot(...p.map((value, k) => value - q[k]!));
  const rows = await page
    .locator("#measure-result span")
    .evaluateAll((spans) => spans.map((span) => span.lastChild!.textContent!.trim()));
  // The test looks along z, so y is up.
  expect(rows).toEqual([
    "3",
    text(Math.hypot(...cross) / 2, "square units"),
    text(Math.abs(cross[1]!) / 2, "square units"),
    text(length(a, b) + length(b, c) + length(c, a), "units"),
  ]);
  expect(await page.locator("#marks .measure").count()).toBe(3);
  await page.getByRole("button", { name: "Clear all" }).click();
  expect(await page.locator("#marks .measure").count()).toBe(0);
});

test("a profile has the points in a strip between two points, drawn and saved", async () => {
  const page = await openBall();
  const seen = await visible(page);
  const [from, to] = await lonely(page, seen, seen);
  await tool(page, "Measure").click();
  await page.getByLabel("Through the surface").check();
  await page.locator("#measure-what label", { hasText: "Profile" }).click();
  await expect.poll(() => page.locator("#measure-result").textContent()).toBe("Click both ends of the profile.");
  await page.getByLabel("Through the surface").uncheck();
  for (const index of [from!, to!]) await clickPoint(page, index);
  await page.getByLabel("Through the surface").check();
  await page.getByLabel("Width of the strip").fill("0.8");
  await page.getByLabel("Width of the strip").press("Tab");
  const coming = page.waitForEvent("download");
  await page.getByRole("button", { name: "Save as CSV" }).click();
  const lines = readFileSync(await (await coming).path(), "utf8")
    .trim()
    .split("\n");

  const [a, b] = [at(from!), at(to!)];
  const [dx, dz] = [b[0] - a[0], b[2] - a[2]];
  const length = Math.hypot(dx, dz);
  const inside = everything.flatMap((i) => {
    const [x, z] = [at(i)[0] - a[0], at(i)[2] - a[2]];
    const along = (x * dx + z * dz) / length;
    const across = Math.abs(x * dz - z * dx) / length;
    return along >= 0 && along <= length && across <= 0.4 ? [{ i, along }] : [];
  });
  expect(lines[0]).toBe("index,along,height,x,y,z");
  expect(new Set(lines.slice(1).map((line) => Number(line.split(",")[0])))).toEqual(new Set(inside.map(({ i }) => i)));
  for (const line of lines.slice(1)) {
    const [index, along, height] = line.split(",").map(Number) as [number, number, number];
    expect(along).toBeCloseTo(inside.find(({ i }) => i === index)!.along, 8);
    expect(height).toBe(at(index)[1]);
  }
  expect(await page.locator(".profile canvas").getAttribute("aria-label")).toMatch(
    new RegExp(`^Profile: ${inside.length} points in the strip, heights from `),
  );
});

test("an E57 file is opened, and a damaged one is refused", async () => {
  const page = await openReady("?sample=bunny");
  const buffer = readFileSync(join(import.meta.dirname, "fixtures/two-scans.e57"));
  const open = (name: string, content: Buffer) =>
    page.locator("#file").setInputFiles({ name, mimeType: "", buffer: content });
  await open("broken.e57", buffer.subarray(0, 5000));
  expect((await reached(page, "error")).sentence).toMatch(/^broken\.e57 cannot be read: .*truncated.*near byte 0/);
  await open("scans.e57", buffer);
  await page.waitForFunction(() => document.querySelector("#status")?.getAttribute("data-total") === "44");
});

test("a file with stations is calibrated by them: their own points are counted, and the view has this thickness", async () => {
  const page = await openReady("?sample=bunny");
  const fixture = join(import.meta.dirname, "fixtures/two-scans.e57");
  await page.locator("#file").setInputFiles(fixture);
  await page.waitForFunction(() => document.querySelector("#status")?.getAttribute("data-total") === "44");
  const before = await settled(page);
  const message = page.locator("#message");
  expect(await message.locator("p").textContent()).toContain("The file says where its points were measured from.");
  await message.getByRole("button", { name: "Calibrate by its stations" }).click();
  await message.getByRole("button", { name: "Undo" }).waitFor();

  const { positions, stations } = await readCloud(fixture);
  const kept = Array.from({ length: positions.length / 3 }, (_, i) => i).filter((i) =>
    Number.isFinite(positions[3 * i]),
  );
  const own = stations!.map(({ viewpoint, indices }) => ({
    viewpoint,
    indices: Array.from(indices, (index) => kept.indexOf(index)),
  }));
  const finite = Float64Array.from(kept.flatMap((i) => [...positions.subarray(3 * i, 3 * i + 3)]));
  const found = await inNode(finite, (cloud) => {
    const { recall, options } = cloud.calibrate(own);
    const see = (settings: object) => cloud.visibleFrom(before.viewpoint, settings).indices.length;
    return { recall, with: see(options), without: see({ looks: 3 }) };
  });
  expect(found.with).not.toBe(found.without);
  const seen = found.recall.reduce((sum, share, s) => sum + share * own[s]!.indices.length, 0);
  expect(await message.locator("p").textContent()).toBe(
    `${Math.floor((100 * seen) / kept.length)}\u00a0% of the scans’ own points can be seen from their stations.`,
  );
  await expect.poll(async () => (await settled(page)).visible).toBe(found.with);
  await message.getByRole("button", { name: "Undo" }).click();
  await expect.poll(async () => (await settled(page)).visible).toBe(found.without);
});
