import { expect, test } from "vitest";
import { captionOf, sentenceOf, type TimedView } from "../../www/view/inquiry.js";
import {
  answerInNode,
  drag,
  dragonPositions,
  openPage,
  openReady,
  picture,
  reached,
  refiltered,
  said,
  settled,
  status,
  unfold,
} from "./support.js";
import { differentPixels } from "./pixels.js";

const SAMPLE = "?sample=dragon_res3&looks=0";

test("zooming out ends while the cloud is in sight, and the first screen has the way back", async () => {
  const page = await openReady("?sample=bunny", {}, async (opened) => {
    await opened.addInitScript(() => {
      localStorage.removeItem("hidden-point-removal: tools");
    });
  });
  const { viewpoint } = await status(page);
  await page.locator("#view").focus();
  for (let i = 0; i < 150; i++) await page.keyboard.press("-");
  const far = (await settled(page)).viewpoint;
  expect(Math.hypot(...far) / Math.hypot(...viewpoint)).toBeLessThan(31);
  await page.getByRole("button", { name: "Reset view" }).click();
  expect((await settled(page)).viewpoint).toEqual(viewpoint);
});

test("the field of view, the size of points and keys in the panel's fields ask nothing, and move nothing", async () => {
  const page = await openReady(SAMPLE);
  const before = await settled(page);
  await unfold(page, "Look");
  for (const [label, value, pixels] of [
    ["Field of view", "20", 500],
    ["Point size", "4", 2000],
  ] as const) {
    const last = await picture(page);
    await page.getByLabel(label, { exact: true }).fill(value);
    expect(await differentPixels(last, await picture(page)), label).toBeGreaterThan(pixels);
  }
  await page.keyboard.press("ArrowRight");
  expect(await settled(page)).toEqual(before);
});

test("zooming, panning and keys move the viewpoint", async () => {
  const page = await openReady(SAMPLE);
  let last = await settled(page);
  const moves: [string, () => Promise<void>][] = [
    ["wheel", () => page.mouse.wheel(0, 300)],
    ["right drag", () => drag(page, 60, 30, "right")],
    ["arrow key", () => page.keyboard.press("ArrowLeft")],
    ["Shift and arrow key", () => page.keyboard.press("Shift+ArrowUp")],
    ["plus key", () => page.keyboard.press("+")],
  ];
  await drag(page, 0, 0);
  await page.locator("#view").focus();
  for (const [name, move] of moves) {
    await move();
    const now = await refiltered(page, last);
    expect(now.viewpoint, name).not.toEqual(last.viewpoint);
    last = now;
  }
  expect(last).toMatchObject(await answerInNode(dragonPositions("_res3"), last));

  const home = await status(await openReady(SAMPLE));
  await unfold(page, "Look");
  await page.getByLabel("Field of view", { exact: true }).fill("20");
  await page.getByRole("button", { name: "Reset view" }).click();
  expect((await refiltered(page, last)).viewpoint).toEqual(home.viewpoint);
  expect(await page.getByLabel("Field of view", { exact: true }).inputValue()).toBe("45");
});

test("hidden points are off, dimmed or shown, and the change asks nothing", async () => {
  const page = await openReady("?sample=bunny");
  const before = await settled(page);
  const off = await picture(page);
  await page.getByRole("radio", { name: "Ghost" }).check();
  const dimmed = await picture(page);
  await page.getByRole("radio", { name: "Highlight" }).check();
  const shown = await picture(page);
  for (const [a, b] of [
    [off, dimmed],
    [dimmed, shown],
    [off, shown],
  ] as const) {
    expect(await differentPixels(a, b)).toBeGreaterThan(2000);
  }
  await page.locator("#view").focus();
  await page.keyboard.press("h");
  await expect.poll(() => page.getByRole("radio", { name: "Hide" }).isChecked()).toBe(true);
  // Removes the ring of the keyboard focus.
  await page.locator("#view").blur();
  expect(await differentPixels(off, await picture(page))).toBe(0);
  expect(await settled(page)).toEqual(before);
});

test("a frozen viewpoint stays while the camera flies around, until it is released", async () => {
  const page = await openReady(SAMPLE);
  const before = await settled(page);
  const unfrozen = await picture(page);
  await page.locator("#view").press("v");
  // The mark at the viewpoint is visible only from another place.
  await page.locator("#view").blur();
  // With the mark, more of space is drawn: depths are rounded a little differently.
  expect(await differentPixels(unfrozen, await picture(page))).toBeLessThan(10);
  await expect.poll(() => page.locator("#status").textContent()).toMatch(/can be seen from the frozen viewpoint/);
  const there = await picture(page);
  await drag(page, 200, 0);
  const frozen = await settled(page);
  expect(frozen.refilters).toBe(before.refilters);
  expect(frozen.viewpoint).toEqual(before.viewpoint);
  expect(await differentPixels(there, await picture(page))).toBeGreaterThan(2000);

  await page.locator("#view").press("v");
  const free = await refiltered(page, frozen);
  expect(free.viewpoint).not.toEqual(before.viewpoint);
  expect(free).toMatchObject(await answerInNode(dragonPositions("_res3"), free));
});

test("the exponent is automatic, then the slider's, then automatic again", async () => {
  const page = await openReady(SAMPLE);
  const automatic = await settled(page);
  await unfold(page, "Advanced");
  const slider = page.getByLabel("Exponent", { exact: true });
  const button = page.getByRole("button", { name: "Automatic" });
  expect(Number(await slider.inputValue())).toBeCloseTo(automatic.exponent, 1);

  await slider.fill("2");
  const manual = await refiltered(page, automatic);
  expect(manual.exponent).toBeCloseTo(2, 12);
  expect(manual.visible).not.toBe(automatic.visible);
  expect(manual).toMatchObject(await answerInNode(dragonPositions("_res3"), manual, { exponent: 2 }));
  expect(await button.getAttribute("aria-pressed")).toBe("false");

  await button.click();
  const again = await refiltered(page, manual);
  expect(again).toMatchObject({ exponent: automatic.exponent, visible: automatic.visible });
});

test("choosing the original up side gives the first view again", async () => {
  const page = await openReady("?sample=dragon_res4&looks=0");
  const inside = await settled(page);
  await unfold(page, "Look");
  await page.locator("#up-axis").getByRole("radio", { name: "Z", exact: true }).check();
  const turned = await refiltered(page, inside);
  expect(turned.viewpoint).not.toEqual(inside.viewpoint);
  await page.locator("#up-axis").getByRole("radio", { name: "Y", exact: true }).check();
  expect((await refiltered(page, turned)).viewpoint).toEqual(inside.viewpoint);
});

test("the sentence and the caption have a singular, a plural and round numbers", () => {
  const answer = (count: number) =>
    ({ visibility: { count }, question: { method: { looks: 3 } }, kind: "looks", milliseconds: 3 }) as TimedView;
  expect(sentenceOf(answer(1), 1, false)).toBe("1 of 1 point can be seen from here.");
  expect(sentenceOf(answer(1), 900, true)).toBe("1 of 900 points can be seen from the frozen viewpoint.");
  expect(captionOf(answer(1), 1, false)).toBe("1 point. 1 can be seen from here.");
  expect(captionOf(answer(38_083), 100_250, false)).toBe("100,000 points. 38,000 can be seen from here.");
  expect(captionOf(answer(57_000), 100_250, true)).toBe("100,000 points. 57,000 can be seen from the eye.");
});

test("the sentence is announced once, after the movement", async () => {
  const page = await openReady(SAMPLE);
  const before = await settled(page);
  const region = page.locator("#announcement");
  await expect.poll(() => region.textContent()).toBe(await said(page));
  const heard = await page.evaluateHandle(() => {
    const [texts, pauses]: [string[], number[]] = [[], []];
    const region = document.getElementById("announcement")!;
    const line = document.getElementById("status")!;
    let last = performance.now();
    new MutationObserver(() => {
      texts.push(region.textContent);
      pauses.push(performance.now() - last);
    }).observe(region, { childList: true });
    // Each answer changes this number.
    new MutationObserver(() => (last = performance.now())).observe(line, { attributeFilter: ["data-refilters"] });
    return { texts, pauses };
  });
  for (let step = 0; step < 3; step++) await drag(page, 40, 10);
  const after = await refiltered(page, before);
  const last = await said(page);
  await expect.poll(() => region.textContent()).toBe(last);
  // Nothing follows. This timer of the page runs after those that were set before it.
  await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 1000)));
  const { texts, pauses } = await heard.jsonValue();
  expect(texts.at(-1)).toBe(last);
  expect(new Set(texts).size).toBe(texts.length);
  // A sentence is announced when no answer has come for a second. A slow machine may rest that long between two drags.
  for (const pause of pauses) expect(pause).toBeGreaterThan(990);
  expect(after.refilters).toBeGreaterThan(before.refilters);
});

test("a refusal is announced, although the picture turns", async () => {
  const page = await openPage("?sample=dragon_res3&turn=1", { reducedMotion: "no-preference" });
  await page.locator('#status[data-answer="map"]').waitFor({ state: "attached" });
  await page
    .locator("#file")
    .setInputFiles({ name: "letter.pdf", mimeType: "", buffer: Buffer.from("%PDF-1.7\n\u0000") });
  const { sentence } = await reached(page, "error");
  await expect.poll(() => page.locator("#announcement").textContent()).toBe(sentence);
  expect(sentence).toMatch(/^letter\.pdf cannot be read/);
});
