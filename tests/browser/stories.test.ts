import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { make as makeRoom } from "../../www/samples/living-room.js";
import { make as makeStreet } from "../../www/samples/street.js";
import { TOLD } from "../../www/stories/stories.js";
import { asciiPly, ball } from "./clouds.js";
import { addressWritten, drag, inNode, openPage, openReady, PHONE, provoke, settled, upToDate } from "./support.js";

type Pair = [number, number];

const says = (page: Page) => page.locator("#story p").textContent();

/** Waits until a step is shown, and its numbers are in its sentence. */
async function told(page: Page, title: keyof typeof TOLD, step: number): Promise<string> {
  const [begin] = TOLD[title].steps[step]!.says.split("{");
  await expect
    .poll(async () => {
      const sentence = (await says(page).catch(() => null)) ?? "";
      return sentence.startsWith(begin!) && !sentence.includes("…");
    })
    .toBe(true);
  await upToDate(page);
  return (await says(page))!;
}

/** A number of an address, such as an index or a part of a place. */
const numbers = (address: string, name: string) =>
  new URLSearchParams(address).getAll(name).map((text) => text.split(",").map(Number));

/** What the package sees of a cloud from the place of a step. */
function maskOf(address: string, positions: Float32Array | Float64Array): Promise<Uint8Array> {
  const [viewpoint] = numbers(address, "view");
  return inNode(positions, (cloud) => cloud.visibleFrom(viewpoint!, { looks: 3 }).mask());
}

test("label: from each place, the names that the words speak of are on points that the package sees", async () => {
  const { positions } = makeRoom();
  const seen = await Promise.all(
    TOLD.label.steps.map(async ({ address }) => {
      const mask = await maskOf(address, positions);
      return numbers(address, "label").map(([index]) => mask[index!]!);
    }),
  );
  const counts = seen.map((names) => names.reduce((sum, one) => sum + one, 0));
  expect(seen[0]).toHaveLength(5);
  expect(counts[0]).toBeGreaterThan(Math.max(counts[1]!, counts[2]!));
  expect(Math.min(...counts)).toBeGreaterThan(0);
});

test("measure: the first tape ends at a hidden point behind the wall, the second at a visible one", async () => {
  const page = await openPage("?story=measure");
  const { positions } = makeStreet();
  const [[far, near], [address]] = [
    TOLD.measure.steps.map((step) => numbers(step.address, "measure")[0] as [number, number]) as [Pair, Pair],
    TOLD.measure.steps.map((step) => step.address) as [string],
  ];
  const length = ([a, b]: Pair) =>
    Math.hypot(...[0, 1, 2].map((axis) => positions[3 * a + axis]! - positions[3 * b + axis]!)).toFixed(1);
  expect(await told(page, "measure", 0)).toContain(`${length(far)} m`);
  const mask = await maskOf(address, positions);
  expect([...far, ...near].map((index) => mask[index])).toEqual([1, 0, 1, 1]);
  await page.getByRole("button", { name: "Next" }).click();
  expect(await told(page, "measure", 1)).toContain(`${length(near)} m`);
  expect(Number(length(far)) - Number(length(near))).toBeGreaterThan(1);

  // The link tells the story. After its end, the address is that of the picture.
  expect(new URL(page.url()).search).toBe("?story=measure");
  await page.getByRole("button", { name: "End" }).click();
  const left = await addressWritten(page);
  expect(left.get("sample")).toBe("street");
  expect(left.has("story")).toBe(false);
  expect(left.get("measure")).toBe(near.join());
  expect(await page.locator("#tool-bar").isVisible()).toBe(true);
});

test("measure: on a phone, both ends of the tape are in the picture", async () => {
  const page = await openPage("?story=measure", PHONE);
  await told(page, "measure", 0);
  const ends = await page
    .locator("#marks .measure .dot")
    .evaluateAll((dots) => dots.map((dot) => dot.getBoundingClientRect()).map(({ left, right }) => [left, right]));
  expect(ends).toHaveLength(2);
  for (const x of ends.flat()) expect(Math.abs(x - 195)).toBeLessThan(195);
});

test("survey: the number is the package's, and another cloud ends it", async () => {
  const page = await openPage("?turn=0", { reducedMotion: "no-preference" }, async (opened) => {
    await opened.addInitScript(() => {
      localStorage.removeItem("hidden-point-removal: tools");
    });
  });
  await page.getByRole("button", { name: "Survey" }).click();
  const sentence = await told(page, "survey", 0);
  const { positions } = makeStreet();
  const [station] = numbers(TOLD.survey.steps[0]!.address, "station");
  const { count } = await inNode(positions, (cloud) => cloud.visibleFrom(station!.slice(0, 3), { looks: 3 }));
  expect(sentence).toContain((positions.length / 3 - count).toLocaleString("en-US"));

  await page
    .locator("#file")
    .setInputFiles({ name: "own.ply", mimeType: "", buffer: Buffer.from(asciiPly(ball(300))) });
  await page.locator('#status[data-total="300"]').waitFor({ state: "attached" });
  expect(await page.locator("#story").count()).toBe(0);
});

test("a story says no number before its answer, and its end and the browser's Back come back to the file and the view before it", async () => {
  const page = await openReady("?sample=bunny");
  await page
    .locator("#file")
    .setInputFiles({ name: "own.ply", mimeType: "", buffer: Buffer.from(asciiPly(ball(300))) });
  await page.locator('#status[data-total="300"]').waitFor({ state: "attached" });
  await drag(page, 40, 20);
  const { viewpoint } = await settled(page);
  // Everything that the story says.
  await page.evaluate(() => {
    const heard: string[] = ((globalThis as { heard?: string[] }).heard = []);
    new MutationObserver(() => {
      const says = document.querySelector("#story p")?.textContent;
      if (says && says !== heard.at(-1)) heard.push(says);
    }).observe(document.getElementById("stage")!, { childList: true, subtree: true, characterData: true });
  });
  const begin = () =>
    page.evaluate(() => {
      document.querySelector<HTMLElement>('[data-story="measure"]')!.click();
    });
  for (const leave of ["Back", "End"] as const) {
    await begin();
    await told(page, "measure", 0);
    if (leave === "Back") {
      await page.getByRole("button", { name: "Next" }).click();
      await told(page, "measure", 1);
      const heard = await page.evaluate(() => (globalThis as { heard?: string[] }).heard!);
      // Each step is said with a gap, and then once with its number.
      expect(heard.map((says) => says.includes("…"))).toEqual([true, false, true, false]);
      await page.goBack();
    } else {
      await page.getByRole("button", { name: "End" }).click();
    }
    await page.locator('#status[data-total="300"]').waitFor({ state: "attached" });
    expect(await page.locator("#story").count()).toBe(0);
    expect((await settled(page)).viewpoint).toEqual(viewpoint);
    expect(new URL(page.url()).search).toBe("");
  }
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
    .toBe("Room behind a wall, 300k could not be read: a part of this page could not be downloaded.");
  expect(await page.locator("#story").count()).toBe(0);
  expect((await addressWritten(page)).get("sample")).toBe("bunny");
});
