import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { readAddress } from "../../www/settings/address.js";
import { USUAL_SETTINGS } from "../../www/settings/settings.js";
import { methodOf } from "../../www/view/inquiry.js";
import { asciiPly, ball } from "./clouds.js";
import { hold, holdable, release } from "./held.js";
import {
  drag,
  dragonPositions,
  inNode,
  openPage,
  openReady,
  picture,
  reached,
  said,
  served,
  settled,
  status,
  upToDate,
} from "./support.js";
import { differentPixels, pixelsOf } from "./pixels.js";

test.for([
  ["", 3, []],
  ["looks=2", 2, []],
  ["looks=0", 0, []],
  ["radius=auto", 0, []],
  ["inversion=spherical", 0, []],
  ["radius=auto&looks=3", 3, []],
  ["looks=1", 3, [/number of looks in the address is not 0, 2 or 3, so it is 3/]],
  ["looks=3&exponent=2", 3, [/Looks in the address exclude exponent/]],
] as const)("?%s", ([query, looks, notes]) => {
  const asked = readAddress(query, ["bunny"]);
  const settings = { ...USUAL_SETTINGS, ...asked.settings };
  expect(settings.looks).toBe(looks);
  expect(asked.notes).toEqual(notes.map((note) => expect.stringMatching(note) as string));
  const hasLooks = looks > 0 && !query.includes("exponent");
  expect(methodOf(settings).looks > 0).toBe(hasLooks);
});

interface Seen {
  answer: string;
  visible: number;
  viewpoint: string;
  busy: string;
  state: string;
}

test("in the page: maps while the camera moves, then looks; a map keeps the numbers of the last answer", async () => {
  const page = await openReady("?sample=dragon_res2");
  const first = await upToDate(page);
  const seen = await page.evaluateHandle(() => {
    const list: Seen[] = [];
    const line = document.getElementById("status")!;
    new MutationObserver(() => {
      const { answer, visible, viewpoint, busy, state } = line.dataset as Record<string, string>;
      list.push({ answer: answer!, visible: Number(visible), viewpoint: viewpoint!, busy: busy!, state: state! });
    }).observe(line, { attributeFilter: ["data-refilters"] });
    return list;
  });
  await drag(page, 150, 30);
  const now = await settled(page);
  const answers = await seen.jsonValue();
  expect(answers.at(-1)!.answer).toBe("looks");
  // On a busy machine the camera may rest between two moves of the drag, and is answered there.
  const maps = answers.slice(
    0,
    answers.findIndex(({ answer }) => answer === "looks"),
  );
  expect(maps.length).toBeGreaterThan(0);
  for (const map of maps) expect(map).toMatchObject({ answer: "map", visible: first.visible, busy: "1" });
  expect(maps.at(-1)!.viewpoint).toBe(answers[maps.length]!.viewpoint);
  const count = await inNode(dragonPositions("_res2"), (cloud) => cloud.visibleFrom(now.viewpoint, { looks: 3 }).count);
  expect(now).toMatchObject({ state: "ready", busy: 0, answer: "looks", visible: count, radius: 0, exponent: 0 });
  expect(now.inversion).toMatch(/^looks:[\d.e-]+,[\d.e-]+,[\d.e-]+$/);
  expect(await said(page)).toMatch(/ points can be seen from here\.$/);
});

/** How many pixels of a picture are the dark background. */
async function empty(image: Buffer): Promise<number> {
  const { data } = await pixelsOf(image);
  let count = 0;
  for (let i = 0; i < data.length; i += 4) {
    if (Math.abs(data[i]! - 20) + Math.abs(data[i + 1]! - 22) + Math.abs(data[i + 2]! - 26) < 6) count++;
  }
  return count;
}

test("while an answer for a new place is awaited, no shadow of the old viewpoint is seen, and a sign says so", async () => {
  const page = await openReady("?sample=dragon_res2&theme=dark", {}, holdable);
  expect(await page.locator("#sign-work").isVisible()).toBe(false);
  await hold(page);
  // By 90°: a drag over the whole height turns the camera once around.
  await drag(page, (await page.locator("#view").boundingBox())!.height / 4, 0);
  await page.locator("#view").blur();
  await page.locator("#sign-work").waitFor();
  const waiting = await status(page);
  expect(waiting).toMatchObject({ state: "ready", busy: 1 });
  const stale = await picture(page);
  await release(page);
  await upToDate(page);
  const final = await picture(page);
  expect(await page.locator("#sign-work").isVisible()).toBe(false);
  const [before, after] = [await empty(stale), await empty(final)];
  // The camera has turned by 90°: with only the old answer, half of the dragon would be missing.
  expect(before).toBeLessThan(1.03 * after);
});

/** Presses keys over the picture, all of them before the next frame. */
async function pressTogether(page: Page, ...keys: string[]): Promise<void> {
  await page.locator("#view").evaluate((canvas, names) => {
    for (const key of names) canvas.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
  }, keys);
}

test("a click that comes before the final answer waits for it, unless the camera moves on", async () => {
  const page = await openReady("?sample=dragon_res3", {}, holdable);
  await page.locator("#tool-pick").click();
  const result = page.locator("#pick-result");
  const picked = () => result.getAttribute("data-index");
  await hold(page);
  await page.locator("#view").press("ArrowLeft");
  await page.locator('#status[data-busy="1"]').waitFor({ state: "attached" });
  await page.locator("#view").press("Enter");
  expect(await result.textContent()).toBe("Click a point.");
  await release(page);
  await expect.poll(picked).toMatch(/^\d+$/);

  await page.locator("#view").press("Escape");
  await hold(page);
  await pressTogether(page, "ArrowLeft", "Enter", "ArrowLeft");
  await release(page);
  await settled(page);
  expect(await picked()).toBeNull();
});

test("a click between a move and the next frame waits for the answer as well", async () => {
  const page = await openReady("?sample=dragon_res3");
  await page.locator("#tool-pick").click();
  await pressTogether(page, "ArrowLeft", "Enter");
  await expect.poll(() => page.locator("#pick-result").getAttribute("data-index")).toMatch(/^\d+$/);
});

test("a click between a move and the next frame finds the point that this frame shows there", async () => {
  // The viewpoint stays, so the answer is final at once.
  const page = await openReady("?sample=dragon_res3&freeze=0.1,0.2,0.3");
  await page.locator("#tool-pick").click();
  const picked = () => page.locator("#pick-result").getAttribute("data-index");
  await pressTogether(page, "ArrowLeft", "Enter");
  const first = await picked();
  expect(first).toMatch(/^\d+$/);
  await picture(page);
  await page.locator("#view").press("Escape");
  await page.locator("#view").press("Enter");
  expect(await picked()).toBe(first);
});

test("the points of a file are drawn before the first answer, and the status has its name and the progress", async () => {
  served.set("clouds/early.ply", asciiPly(ball(40_000)));
  const page = await openPage("?src=clouds/early.ply&theme=dark", {}, async (fresh) => {
    await holdable(fresh);
    await fresh.addInitScript(() => {
      (globalThis as unknown as { hold: () => void }).hold();
    });
  });
  await expect.poll(() => page.locator("#status").textContent()).toMatch(/^Preparing early\.ply: \d+\s%\.$/);
  const early = await picture(page);
  expect((await status(page)).state).toBe("loading");
  const { width, height } = await page.evaluate(() => ({ width: innerWidth, height: innerHeight }));
  expect(await empty(early)).toBeLessThan(0.22 * width * height);
  await release(page);
  await reached(page, "ready");
  await upToDate(page);
  expect(await empty(await picture(page))).toBeLessThan(0.22 * width * height);
});

test("a file that cannot be opened leaves the cloud and the camera as they were, although its points were drawn", async () => {
  const page = await openReady("?sample=bunny");
  await page.locator("#view").press("ArrowLeft");
  await page.locator("#view").blur();
  const before = await settled(page);
  const shown = await picture(page);
  // The last row is cut.
  const text = Buffer.from(asciiPly(ball(40_000))).toString("latin1");
  const broken = Buffer.from(text.slice(0, text.trimEnd().lastIndexOf(" ")), "latin1");
  await page.locator("#file").setInputFiles({ name: "cut.ply", mimeType: "", buffer: broken });
  expect((await reached(page, "error")).sentence).toContain("cut.ply");
  await page.getByRole("button", { name: "Dismiss" }).click();
  expect(await upToDate(page)).toMatchObject({ viewpoint: before.viewpoint, visible: before.visible });
  expect(await differentPixels(shown, await picture(page))).toBe(0);
});
