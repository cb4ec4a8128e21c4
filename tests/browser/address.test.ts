import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { expect, test } from "vitest";
import { asciiPly, ball } from "./clouds.js";
import { answerInNode, dragonPositions, openPage, openReady, reached, served, settled, status } from "./support.js";

const bunny = createRequire(import.meta.url)("bunny") as { positions: number[][] };

test.for([
  ["dragon_res2", 100_250],
  ["dragon_res3", 22_998],
  ["dragon_res4", 5_205],
  ["bunny", 1_839],
  ["room", 300_000],
] as const)("?sample=%s holds %i points", async ([name, points]) => {
  const page = await openReady(`?sample=${name}`);
  const { total, visible } = await status(page);
  expect(total).toBe(points);
  expect(visible).toBeGreaterThan(0);
  expect(visible).toBeLessThan(total);
  expect(await page.locator("#sample").inputValue()).toBe(name);
  expect(await page.locator("#credit").textContent()).toMatch(
    { bunny: /public domain/, room: /Generated/ }[name as string] ?? /Stanford Computer Graphics Laboratory.*no commercial use/,
  );
});

test("?sample, ?view and ?exponent together give exactly the package's answer", async () => {
  const page = await openReady("?sample=bunny&view=1.5,8.25,-12.125&exponent=2.5");
  const now = await settled(page);
  expect(now.viewpoint).toEqual([1.5, 8.25, -12.125]);
  expect(now.exponent).toBeCloseTo(2.5, 12);
  const positions = Float32Array.from(bunny.positions.flat());
  expect(now).toMatchObject(await answerInNode(positions, now, { exponent: 2.5 }));
});

test("?view alone leaves the radius automatic, and looks at the middle of the cloud", async () => {
  const page = await openReady("?sample=dragon_res4&view=0.1,0.2,0.3");
  const now = await settled(page);
  expect(now.viewpoint).toEqual([0.1, 0.2, 0.3]);
  expect(now).toMatchObject(await answerInNode(dragonPositions("_res4"), now));
});

test("?src opens a file from the web", async () => {
  const positions = ball(700);
  served.set("clouds/ball.ply", asciiPly(positions));
  const page = await openReady("?src=clouds/ball.ply&view=0,0,9");
  const now = await settled(page);
  expect(now.total).toBe(700);
  expect(now.viewpoint).toEqual([0, 0, 9]);
  expect(now).toMatchObject(await answerInNode(positions, now));
  expect(await page.locator("#sample option:checked").textContent()).toBe("ball.ply");
});

test("what the address asks for and cannot have is said in a plain sentence", async () => {
  const page = await openReady("?sample=unicorn&exponent=-1&view=1,2");
  expect((await status(page)).total).toBe(437_645);
  const message = await page.locator("#message").textContent();
  for (const part of [/no sample called “unicorn”/, /exponent .* is not a number/, /view .* is not three numbers/]) {
    expect(message).toMatch(part);
  }
});

test("?src of a page instead of a cloud is refused in a plain sentence", async () => {
  served.set("clouds/lost.ply", readFileSync(new URL("../../www/index.html", import.meta.url)));
  const { sentence } = await reached(await openPage("?src=clouds/lost.ply"), "error");
  expect(sentence).toMatch(/lost\.ply is not a point cloud/);
});
