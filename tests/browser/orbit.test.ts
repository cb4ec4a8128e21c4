// While the camera turns, every frame is drawn by a map: neither all points, nor the shadow of an old viewpoint.
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { openReady, upToDate } from "./support.js";

interface Frame {
  brightness: number;
  answer: string;
  visible: string;
  busy: string;
  refilters: number;
}

/** Keeps the mean brightness of every frame that is drawn, and what the status says in it. */
async function record(page: Page): Promise<void> {
  await page.evaluate(() => {
    const canvas = document.querySelector<HTMLCanvasElement>("#view")!;
    const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", { willReadFrequently: true })!;
    const frames: Frame[] = [];
    const frame = () => {
      copy.drawImage(canvas, 0, 0);
      const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
      // Otherwise nothing was drawn in this frame.
      if (data[3] === 255) {
        let sum = 0;
        for (let i = 0; i < data.length; i += 4) sum += data[i]! + data[i + 1]! + data[i + 2]!;
        const { answer, visible, busy, refilters } = document.getElementById("status")!.dataset as Record<
          string,
          string
        >;
        frames.push({
          brightness: sum / (0.75 * data.length),
          answer: answer!,
          visible: visible!,
          busy: busy!,
          refilters: Number(refilters),
        });
      }
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
    Object.assign(globalThis, { frames });
  });
}

const taken = (page: Page) => page.evaluate(() => (globalThis as unknown as { frames: Frame[] }).frames.splice(0));

/** The brightness of the final picture. */
async function brightness(page: Page): Promise<number> {
  await upToDate(page);
  await page.waitForTimeout(200);
  return (await taken(page)).at(-1)!.brightness;
}

test("while a drag turns the camera, each frame shows what can be seen", async () => {
  const address = "?sample=dragon_res2&size=0.35&theme=dark";
  const page = await openReady(address);
  await upToDate(page);
  // The first map is being prepared.
  await page.waitForTimeout(1000);
  await record(page);
  const box = (await page.locator("#view").boundingBox())!;
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 4, y);
  await page.waitForTimeout(100);
  await taken(page);
  for (let i = 2; i <= 30; i++) {
    await page.mouse.move(x + 4 * i, y);
    await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(resolve)));
  }
  const moving = await taken(page);
  await page.mouse.up();
  const last = await upToDate(page);
  const rest = await brightness(page);
  const view = new URL(page.url()).searchParams.get("view")!;
  const other = await openReady(`${address}&view=${view}&compare=0.999`);
  await record(other);
  await other.locator("#view").press("ArrowLeft");
  await other.locator("#view").press("ArrowRight");
  const all = await brightness(other);
  expect(moving.length).toBeGreaterThan(20);
  // Frames are drawn by maps, unless a busy machine rests between two moves, and the number stays that of the last answer.
  const byMap = moving.filter(({ answer }) => answer === "map");
  expect(byMap.length).toBeGreaterThan(0.7 * moving.length);
  expect(new Set(moving.map(({ answer }) => answer)).has("draft")).toBe(false);
  expect(byMap[0]!.busy).toBe("1");
  for (const [i, { answer, visible, refilters }] of moving.entries()) {
    const before = moving[i - 1];
    if (answer === "map" && before?.refilters === refilters - 1) expect(visible).toBe(before.visible);
  }
  expect(moving.at(-1)!.refilters - moving[0]!.refilters).toBeGreaterThan(12);
  // The last frames are of nearly the same place as the picture at rest: .04 to .1 of the way to all points was measured. On
  // a busy machine some come before the map of their place.
  const ways = moving.slice(-4).map(({ brightness }) => Math.abs(brightness - rest) / Math.abs(all - rest));
  expect(Math.min(...ways)).toBeLessThan(0.15);
  expect(last).toMatchObject({ answer: "looks", busy: 0 });
});
