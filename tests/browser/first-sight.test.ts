import { type BrowserContextOptions, type Page } from "playwright-core";
import { expect, test } from "vitest";
import { ball, rows } from "./clouds.js";
import { addStyle } from "./site.js";
import {
  addressWritten,
  answerInNode,
  drag,
  EVERY_PIXEL,
  openPage,
  openReady,
  PHONE,
  picture,
  reached,
  refiltered,
  said,
  served,
  status,
  upToDate,
} from "./support.js";
import { apart, type Pixels, pixelsOf } from "./pixels.js";
import { make as makeRoom } from "../../www/samples/living-room.js";

const MOVING: BrowserContextOptions = { reducedMotion: "no-preference" };

/** The page as a stranger opens it. */
const stranger = async (page: Page) => {
  await page.addInitScript(() => {
    localStorage.removeItem("hidden-point-removal: tools");
  });
};

const caption = (page: Page) => page.locator("#caption").textContent();
const line = async (page: Page) => Number(await page.locator("#divider").getAttribute("aria-valuenow"));

/** Everything in sight that takes the focus. */
const controls = (page: Page) =>
  page.evaluate(
    () =>
      [...document.querySelectorAll<HTMLElement>("a[href], button, input, select, summary, [tabindex='0']")].filter(
        (element) =>
          element.checkVisibility({ visibilityProperty: true }) && element.closest("[aria-hidden=true]") === null,
      ).length,
  );

test("a stranger sees the cloud turn, a line sweep over it, a caption with its numbers, and few controls", async () => {
  const page = await openPage("", MOVING, stranger);
  await reached(page, "ready");
  await page.locator("#divider").waitFor();
  await expect.poll(() => line(page)).toBe(50);
  const round = (count: number) => Number(count.toPrecision(2)).toLocaleString("en-US");
  // Where a frame takes long, the camera rests in between and is answered there. The caption follows later.
  await expect
    .poll(
      async () =>
        (await caption(page)) === `300,000 points. ${round((await status(page)).visible)} can be seen from here.`,
    )
    .toBe(true);
  expect((await status(page)).total).toBe(300_000);
  expect(await controls(page)).toBeLessThanOrEqual(20);
  expect(await page.locator("#panel").evaluate((panel) => panel.getBoundingClientRect().width)).toBeLessThan(2);
  // It goes on turning, and maps draw it.
  const before = await status(page);
  await expect.poll(async () => (await status(page)).viewpoint).not.toEqual(before.viewpoint);
  await expect.poll(() => status(page)).toMatchObject({ answer: "map", busy: 1 });
  expect(new URL(page.url()).search).toBe("");
  // Any touch stops it. The line stays.
  await page.locator("#view").click({ position: { x: 20, y: 200 } });
  const stopped = await upToDate(page);
  await page.waitForTimeout(300);
  expect((await status(page)).viewpoint).toEqual(stopped.viewpoint);
  expect(await line(page)).toBe(50);
});

test("in both themes, the two halves differ in a quarter of the body's pixels or more, and only the left one shows through the wall", async () => {
  const page = await openReady(
    "?turn=0&compare=0",
    { ...EVERY_PIXEL, viewport: { width: 1280, height: 720 } },
    stranger,
  );
  await addStyle(page, "#divider { opacity: 0 } #compare-note, #verbs, #name, #drawer, #signs { visibility: hidden }");
  for (const colorScheme of ["dark", "light"] as const) {
    await page.emulateMedia({ colorScheme });
    const pictures: Buffer[] = [];
    for (const end of ["Home", "End"]) {
      await page.locator("#divider").focus();
      await page.keyboard.press(end);
      pictures.push(await picture(page));
    }
    const [front, all] = (await Promise.all(pictures.map(pixelsOf))) as [Pixels, Pixels];
    const { width, height } = all;
    // The background is in the corner at the right.
    const isPoint = ({ data }: Pixels, x: number, y: number) =>
      [0, 1, 2].some((i) => Math.abs(data[4 * (y * width + x) + i]! - data[4 * (width - 1) + i]!) > 8);
    // The body of the cloud: every place with a point at most two pixels away.
    let [body, different] = [0, 0];
    for (let y = 2; y < height - 2; y++) {
      for (let x = 2; x < width - 2; x++) {
        let isBody = false;
        for (let dy = -2; dy <= 2 && !isBody; dy++) {
          for (let dx = -2; dx <= 2; dx++) isBody ||= isPoint(all, x + dx, y + dy);
        }
        if (!isBody) continue;
        body++;
        if (apart(front, all, 4 * (y * width + x)) > 16) different++;
      }
    }
    expect(body, colorScheme).toBeGreaterThan(30_000);
    expect(different / body, colorScheme).toBeGreaterThan(0.25);
    // The wall is left of the middle.
    const gaps = [front, all].map((pixels) => {
      let empty = 0;
      for (let y = 200; y < 400; y++) for (let x = 300; x < 500; x++) empty += isPoint(pixels, x, y) ? 0 : 1;
      return empty / 40_000;
    });
    expect(gaps[0], `${colorScheme}: visible points`).toBeLessThan(0.005);
    expect(gaps[1], `${colorScheme}: all points`).toBeGreaterThan(0.2);
  }
});

test("with reduced motion nothing turns, and the line stands in the middle at once", async () => {
  const page = await openReady("", {}, stranger);
  const { viewpoint } = await status(page);
  await page.locator("#divider").waitFor();
  expect(await line(page)).toBe(50);
  await page.waitForTimeout(500);
  expect(await status(page)).toMatchObject({ viewpoint, busy: 0 });
});

test("the address says whether the picture turns", async () => {
  const page = await openPage("?sample=bunny&turn=1", MOVING);
  await reached(page, "ready");
  const { viewpoint } = await status(page);
  await expect.poll(async () => (await status(page)).viewpoint).not.toEqual(viewpoint);
  const still = await openReady("?turn=0", MOVING);
  const before = (await status(still)).viewpoint;
  await still.waitForTimeout(400);
  expect((await upToDate(still)).viewpoint).toEqual(before);
});

test("freeze and walk around: an eye stands where the viewpoint was, hidden points are ghosts, and the eye can be moved", async () => {
  const page = await openReady("?sample=bunny", {}, stranger);
  const { viewpoint } = await status(page);
  await page.getByRole("button", { name: "Freeze and walk around" }).click();
  const frozen = await upToDate(page);
  expect(frozen.viewpoint).toEqual(viewpoint);
  expect((await addressWritten(page)).get("hidden")).toBe("dimmed");
  await expect.poll(() => caption(page)).toMatch(/^1,839 points\. [\d,]+ can be seen from the eye\.$/);
  await drag(page, 150, 40);
  await page.getByRole("button", { name: "Move the eye here" }).click();
  await expect.poll(async () => (await upToDate(page)).viewpoint).not.toEqual(viewpoint);
  const moved = await upToDate(page);
  const address = await addressWritten(page);
  expect(address.get("freeze")!.split(",").map(Number)).toEqual(moved.viewpoint);
  await page.getByRole("button", { name: "Unfreeze" }).click();
  expect((await addressWritten(page)).has("freeze")).toBe(false);
  expect((await addressWritten(page)).has("hidden")).toBe(false);
});

test("the camera walks once around a frozen eye, and any touch stops it", async () => {
  const page = await openReady("?sample=bunny", MOVING, stranger);
  const camera = async () => (await addressWritten(page)).get("view");
  await page.getByRole("button", { name: "Freeze and walk around" }).click();
  const first = await page.locator("#view").screenshot();
  await expect.poll(async () => (await page.locator("#view").screenshot()).equals(first)).toBe(false);
  await page.locator("#view").click({ position: { x: 20, y: 200 } });
  const stopped = await camera();
  await page.waitForTimeout(400);
  expect(await camera()).toBe(stopped);
});

test("the drawer has the tools, and this device remembers it", async () => {
  const page = await openPage("?sample=bunny", {});
  await reached(page, "ready");
  expect(await page.locator("#hidden-points").isVisible()).toBe(true);
  await page.getByRole("button", { name: "Close tools" }).click();
  expect(await page.locator("#hidden-points").isVisible()).toBe(false);
  expect(await page.evaluate(() => localStorage.getItem("hidden-point-removal: tools"))).toBe("closed");
  await page.getByRole("button", { name: "Tools", exact: true }).click();
  expect(await page.locator("#tool-bar").isVisible()).toBe(true);
});

test("at every size the page says in one sentence what it is for whom, and the picture keeps its height", async () => {
  const page = await openReady("", { ...PHONE, viewport: { width: 1440, height: 900 } }, stranger);
  await page.locator("#divider").waitFor();
  for (const [width, height, share] of [
    [1440, 900, 0.8],
    [1280, 720, 0.75],
    [390, 844, 0.7],
    [640, 360, 0.5],
  ] as const) {
    await page.setViewportSize({ width, height });
    const top = await page.locator("#caption").evaluate((element) => element.getBoundingClientRect().top);
    expect(top / height, `${width} × ${height}`).toBeGreaterThan(share);
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(width);
    const { x, y, width: wide, height: high } = (await page.locator("#name").boundingBox())!;
    const corner = (await page.locator("#drawer").boundingBox())!;
    expect(Math.min(x, y)).toBeGreaterThanOrEqual(0);
    expect(x + wide).toBeLessThanOrEqual(corner.x);
    expect(y + high).toBeLessThan(0.5 * top);
    for (const words of await page.locator("#compare-note span").all()) {
      const beside = (await words.boundingBox())!;
      const isApart = beside.x >= x + wide || beside.y >= y + high || beside.y + beside.height <= y;
      expect(isApart, `${width} × ${height}: ${await words.textContent()}`).toBe(true);
    }
  }
  const [told] = await page.locator("[data-verdict]").allInnerTexts();
  expect(told).toMatch(/^Room: \d\.\d % wrong; a z-buffer \d+\.\d %$/);
  expect(await page.locator("#name").innerText()).toMatch(/^Hidden-point removal finds which points of a scan/);
});

test("one stray point does not make the cloud a dot, and Show all shows it", async () => {
  served.set(
    "stray.xyz",
    new TextEncoder().encode(
      `${rows(ball(2000))
        .map((row) => `${row.join(" ")}\n`)
        .join("")}90000 70000 5\n`,
    ),
  );
  const page = await openReady("?src=stray.xyz&up=z");
  const far = async () => Math.hypot(...(await upToDate(page)).viewpoint);
  expect(await far()).toBeLessThan(20);
  expect(await page.locator("#message p").textContent()).toMatch(/A few points lie far away/);
  await page.getByRole("button", { name: "Show all" }).click();
  await expect.poll(far).toBeGreaterThan(50_000);
});

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
