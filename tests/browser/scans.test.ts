// Files of scanners with the places of their stations.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { readCloud } from "hidden-point-removal/files";
import { expect, test } from "vitest";
import { ball, rows, text } from "./clouds.js";
import { choose } from "./files.js";
import { inNode, openReady, reached, settled } from "./support.js";

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

/** A rough ball in PTX, scanned from two sides. A beam that misses the side that faces the scanner has no point. */
function roughBall(): string {
  const scans = [
    [0, 0, 8],
    [8, 0, 0],
  ].map((at, scan) => {
    const lines = rows(ball(1000)).map((point, i) => {
      const beam = point.map((value, axis) => value - at[axis]!);
      const faces = point.reduce((sum, value, axis) => sum + value * beam[axis]!, 0) < 0;
      const error = faces ? 1 + 0.0125 * Math.sin(1e4 * Math.sin(i + 1000 * scan)) : 0;
      return [...beam.map((value) => value * error), 0.5].join(" ");
    });
    const place = at.join(" ");
    const turned = ["1 0 0 0", "0 1 0 0", "0 0 1 0", `${place} 1`];
    return [1, lines.length, place, "1 0 0", "0 1 0", "0 0 1", ...turned, ...lines, ""].join("\n");
  });
  return scans.join("");
}

test("a file with stations is calibrated by them: their own points are counted, and the view has this thickness", async () => {
  const page = await openReady("?sample=bunny");
  const content = roughBall();
  const { positions, stations } = await readCloud(new Blob([content]));
  const kept = Array.from({ length: positions.length / 3 }, (_, i) => i).filter((i) =>
    Number.isFinite(positions[3 * i]),
  );
  await choose(page, "ball.ptx", text(content));
  await page.locator(`#status[data-total="${kept.length}"]`).waitFor({ state: "attached" });
  const before = await settled(page);
  const message = page.locator("#message");
  expect(await message.locator("p").textContent()).toContain("The file says where its points were measured from.");
  await message.getByRole("button", { name: "Calibrate by its stations" }).click();
  await message.getByRole("button", { name: "Undo" }).waitFor();

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
