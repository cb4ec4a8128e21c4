import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { make as makeRoom } from "../../www/samples/living-room.js";
import { make as makeStreet } from "../../www/samples/street.js";
import { TOLD } from "../../www/stories/stories.js";
import { asciiPly, ball } from "./clouds.js";
import { addressWritten, inNode, openPage, openReady, provoke, status, upToDate } from "./support.js";

const says = (page: Page) => page.locator("#story p").textContent();

/** Waits until a step is shown, and its numbers are in its sentence. */
async function told(page: Page, title: keyof typeof TOLD, step: number): Promise<string> {
  const [begin] = TOLD[title].steps[step]!.says.split("{");
  await expect
    .poll(
      async () => {
        const sentence = (await says(page).catch(() => null)) ?? "";
        return sentence.startsWith(begin!) && !sentence.includes("…");
      },
      { timeout: 120_000 },
    )
    .toBe(true);
  await upToDate(page);
  return (await says(page))!;
}

const next = (page: Page) => page.getByRole("button", { name: "Next" }).click();

/** A number of an address, such as an index or a part of a place. */
const numbers = (address: string, name: string) =>
  new URLSearchParams(address).getAll(name).map((text) => text.split(",").map(Number));

test("measure: the first tape ends at a hidden point behind the wall, the second at a visible one", async () => {
  const page = await openPage("?story=measure");
  const { positions } = makeStreet();
  const [far, near] = TOLD.measure.steps.map(({ address }) => numbers(address, "measure")[0] as [number, number]);
  const length = ([a, b]: [number, number]) =>
    Math.hypot(...[0, 1, 2].map((axis) => positions[3 * a + axis]! - positions[3 * b + axis]!)).toFixed(1);
  expect(await told(page, "measure", 0)).toContain(`${length(far!)} m`);
  const { viewpoint } = await status(page);
  const mask = await inNode(positions, (cloud) => cloud.visibleFrom(viewpoint, { looks: 3 }).mask());
  expect([...far!, ...near!].map((index) => mask[index])).toEqual([1, 0, 1, 1]);
  await next(page);
  expect(await told(page, "measure", 1)).toContain(`${length(near!)} m`);
  expect(Number(length(far!)) - Number(length(near!))).toBeGreaterThan(1);

  // The link tells the story. After its end, the address is that of the picture.
  expect(new URL(page.url()).search).toBe("?story=measure");
  await page.getByRole("button", { name: "End" }).click();
  const address = await addressWritten(page);
  expect(address.get("sample")).toBe("street");
  expect(address.has("story")).toBe(false);
  expect(address.get("measure")).toBe(near!.join());
  expect(await page.locator("#tool-bar").isVisible()).toBe(true);
});

test("label: names are there exactly where the package sees their points", async () => {
  const page = await openPage("?story=label", { viewport: { width: 1440, height: 900 } });
  const { positions } = makeRoom();
  for (const [step, { address }] of TOLD.label.steps.entries()) {
    if (step > 0) await next(page);
    await told(page, "label", step);
    const { viewpoint } = await status(page);
    const mask = await inNode(positions, (cloud) => cloud.visibleFrom(viewpoint, { looks: 3 }).mask());
    const labels = new URLSearchParams(address).getAll("label").map((text) => text.split(","));
    const expected = labels.filter(([index]) => mask[Number(index)]).map(([, name]) => name!);
    const shown = () =>
      page.evaluate(() =>
        [...document.querySelectorAll<SVGGElement>("#marks .note")]
          .filter((note) => note.style.display !== "none")
          .map((note) => note.textContent),
      );
    await expect.poll(async () => (await shown()).sort(), { message: `step ${step}` }).toEqual(expected.sort());
    expect(expected.length).toBeGreaterThan(0);
    if (step > 0) expect(expected.length).toBeLessThan(labels.length);
  }
});

test("survey: the number that neither station sees is the package's", async () => {
  const page = await openPage("?story=survey");
  const { positions } = makeStreet();
  for (const step of [0, 1]) {
    if (step > 0) await next(page);
    const sentence = await told(page, "survey", step);
    const stations = new URLSearchParams(TOLD.survey.steps[step]!.address)
      .getAll("station")
      .map((text) => text.split(",").slice(0, 3).map(Number));
    const counts = await inNode(positions, (cloud) => cloud.coverage(stations, { looks: 3 }));
    const unseen = counts.reduce((sum, count) => sum + Number(count === 0), 0);
    expect(sentence).toContain(unseen.toLocaleString("en-US"));
  }
});

test("a story goes on by itself until it is touched, and another cloud ends it", async () => {
  const page = await openPage("?turn=0", { reducedMotion: "no-preference" }, async (opened) => {
    await opened.addInitScript(() => {
      localStorage.removeItem("hidden-point-removal: tools");
    });
  });
  await page.getByRole("button", { name: "Label" }).click();
  await told(page, "label", 0);
  await expect.poll(() => page.locator("#story[data-waits]").count()).toBe(1);
  await page.locator("#view").click({ position: { x: 20, y: 200 } });
  expect(await page.locator("#story[data-waits]").count()).toBe(0);
  await page
    .locator("#file")
    .setInputFiles({ name: "own.ply", mimeType: "", buffer: Buffer.from(asciiPly(ball(300))) });
  await page.locator('#status[data-total="300"]').waitFor({ state: "attached" });
  expect(await page.locator("#story").count()).toBe(0);
});

test("a story that does not exist is named", async () => {
  const page = await openPage("?story=fishing&sample=bunny");
  await upToDate(page);
  expect(await page.locator("#message p").textContent()).toMatch(/^The story in the address is not `?measure/);
});

test("if the cloud of a story cannot be had, a message says so and the story ends", async () => {
  provoke(/ERR_FAILED/);
  const page = await openReady("?sample=bunny");
  await page.route("**/living-room-*.js", (route) => route.abort());
  await page.evaluate(() => {
    document.querySelector<HTMLElement>('[data-story="label"]')!.click();
  });
  await expect
    .poll(() => page.locator("#message p").textContent())
    .toBe("Room from inside, 300k could not be read: a part of this page could not be downloaded.");
  expect(await page.locator("#story").count()).toBe(0);
  expect((await addressWritten(page)).get("sample")).toBe("bunny");
});
