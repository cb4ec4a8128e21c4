import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { make as makeRoom } from "../../www/samples/living-room.js";
import { addressWritten, answerInNode, drag, openReady, refiltered, said, status } from "./support.js";

/** How many frames are drawn until the next answer. */
function framesToAnswer(page: Page): Promise<number> {
  return page.evaluate(
    () =>
      new Promise((resolve) => {
        const refilters = () => Number(document.getElementById("status")!.dataset["refilters"]);
        const start = refilters();
        let count = 0;
        requestAnimationFrame(function frame() {
          if (refilters() > start) {
            resolve(count);
          } else {
            count++;
            requestAnimationFrame(frame);
          }
        });
      }),
  );
}

test("the page opens on the room, goes on drawing while it is asked, and every answer is the package's own", async () => {
  const { positions } = makeRoom();
  const page = await openReady();
  const first = await status(page);
  expect(first.total).toBe(300_000);
  expect(first.visible).toBeGreaterThan(0);
  expect(first.visible).toBeLessThan(first.total);
  expect(await said(page)).toMatch(/^[\d,]+ of 300,000 points can be seen from here\.$/);
  expect(first).toMatchObject(await answerInNode(positions, first));
  // A visitor who has done nothing yet gets the divided picture again at the next visit.
  await page.locator("#divider").waitFor();
  expect((await addressWritten(page)).size).toBe(0);

  const frames = framesToAnswer(page);
  await drag(page, 180, 40);
  // At least one whole frame between a question and its answer: the page never waits for the hull.
  expect(await frames).toBeGreaterThan(1);
  // Then the newest viewpoint is answered.
  const second = await refiltered(page, first);
  await expect
    .poll(() => new URL(page.url()).search)
    .toMatch(/^\?sample=room&compare=0\.5&view=[^&]+&target=1,1\.25,0$/);
  expect(second.refilters).toBeGreaterThan(first.refilters);
  expect(second.viewpoint).not.toEqual(first.viewpoint);
  expect(second.visible).not.toBe(first.visible);
  expect(second).toMatchObject(await answerInNode(positions, second));
});
