import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { expect, test } from "vitest";
import { readAddress } from "../../www/settings/address.js";
import { asciiPly, ball } from "./clouds.js";
import {
  answered,
  answerInNode,
  dragonPositions,
  openPage,
  openReady,
  reached,
  refiltered,
  served,
  settled,
  status,
} from "./support.js";

const bunny = createRequire(import.meta.url)("bunny") as { positions: number[][] };

test("?sample=dragon_res3 shows this sample, with its license", async () => {
  const page = await openReady("?sample=dragon_res3&looks=0");
  const { total, visible } = await status(page);
  expect(total).toBe(22_998);
  expect(visible).toBeGreaterThan(0);
  expect(visible).toBeLessThan(total);
  expect(await page.locator("#sample").inputValue()).toBe("dragon_res3");
  expect(await page.locator("#panel .credit").textContent()).toMatch(
    /Stanford Computer Graphics Laboratory.*no commercial use/,
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
  expect(await page.locator("#panel .credit").textContent()).toContain("ball.ply");
});

test("a plain sentence names each parameter of the address that cannot be met", async () => {
  const page = await openReady("?sample=unicorn&exponent=-1&view=1,2");
  expect(await page.locator("#sample").inputValue()).toBe("room");
  const message = await page.locator("#message").textContent();
  for (const part of [/no sample called “unicorn”/, /exponent .* is not a number/, /view .* is not three numbers/]) {
    expect(message).toMatch(part);
  }
});

test.for([
  [
    "exponent=400&points=1.5&src=",
    [
      /exponent in the address is not a number from 0 to 6/,
      /names no file after “src=”/,
      /number of points in the address is not an integer from 1 to 10000000, so the largest of these is used/,
    ],
  ],
  [
    "radius=-1&inversion=power&freeze=1&hidden=maybe&size=0&fov=400&up=x&target=1,2&compare=2&theme=sepia",
    [
      /radius/,
      /inversion/,
      /frozen viewpoint/,
      /hidden points/,
      /point size/,
      /field of view/,
      /side that is up/,
      /target/,
      /place of the divider/,
      /theme in the address is not system, dark or light/,
    ],
  ],
] as const)("?%s: each is refused with a note, and nothing of it is used", ([query, notes]) => {
  const asked = readAddress(query, ["bunny"]);
  for (const note of notes) expect(asked.notes.join(" ")).toMatch(note);
  expect(asked.notes).toHaveLength(notes.length);
  expect(asked).toMatchObject({ settings: {}, src: null, view: null, target: null });
});

test("if the exponent cannot be used and a radius is given, the radius is used, and the message says so", async () => {
  const page = await openReady("?sample=dragon_res4&exponent=abc&radius=9");
  expect(await settled(page)).toMatchObject({ answer: "operator", radius: 9 });
  expect(await page.locator("#message p").textContent()).toBe(
    "The exponent in the address is not a number from 0 to 6, so the radius is used.",
  );
});

test("a view and a frozen viewpoint out of reach are refused with a note, and the sample is seen as usual", async () => {
  const usual = await status(await openReady("?sample=bunny"));
  const page = await openReady("?sample=bunny&view=1e19,0,0&freeze=1e300,0,0");
  const { state, total, visible, viewpoint } = usual;
  expect(await settled(page)).toMatchObject({ state, total, visible, viewpoint });
  const message = await page.locator("#message").textContent();
  expect(message).toMatch(/view in the address is too far away.*frozen viewpoint in the address is too far away/);
});

test("a target out of reach is refused with a note, and the address keeps no invalid numbers", async () => {
  const page = await openReady("?sample=bunny&view=0,5,30&target=1e300,0,0");
  expect((await settled(page)).viewpoint).toEqual([0, 5, 30]);
  expect(await page.locator("#message").textContent()).toMatch(/target in the address is too far away/);
  await page.waitForFunction(() => !location.search.includes("target="));
  expect(page.url()).toContain("view=0,5,30");
});

test("a sample that is picked is in the address", async () => {
  const page = await openReady("?sample=bunny&view=1,2,3&exponent=2");
  const before = await status(page);
  await page.locator("#sample").selectOption("dragon_res4");
  await answered(page, before);
  expect(new URL(page.url()).search).toBe("?sample=dragon_res4&exponent=2");
});

test("?src is refused in a plain sentence if it is no address of a file", async () => {
  for (const [src, sentence] of [
    ["//", "“//” is not the address of a file."],
    ["data:text/plain,1", "“data:text/plain,1” is not the address of a file."],
  ] as const) {
    const page = await openPage(`?src=${src}&sample=bunny`);
    expect((await reached(page, "error")).sentence).toBe(sentence);
  }
});

test("?src of a page instead of a cloud is refused in a plain sentence, and the usual sample is there", async () => {
  served.set("clouds/lost.ply", readFileSync(new URL("../../www/index.html", import.meta.url)));
  const page = await openPage("?src=clouds/lost.ply&sample=bunny");
  const { sentence } = await reached(page, "error");
  expect(sentence).toMatch(/lost\.ply cannot be read: it is XML or a page of the web/);
  await page.locator('#status[data-total="1839"]').waitFor();
  const now = await settled(page);
  expect(now.state).toBe("error");
  expect(await page.locator("#status").textContent()).toBe(sentence);
  expect(await page.locator("#message p").textContent()).toBe(sentence);
  expect(await page.locator("#sample").inputValue()).toBe("bunny");
  await page.locator("#view").press("ArrowLeft");
  expect((await refiltered(page, now)).state).toBe("ready");
});
