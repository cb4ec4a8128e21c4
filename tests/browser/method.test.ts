import type { VisibilityOptions } from "hidden-point-removal";
import { ringOfViewpoints } from "hidden-point-removal";
import { expect, test } from "vitest";
import { ball, asciiPly } from "./clouds.js";
import {
  answerInNode,
  drag,
  dragonPositions,
  inNode,
  middleOf,
  openReady,
  reached,
  served,
  status,
  type Status,
  unfold,
  upToDate,
} from "./support.js";

const SAMPLE = "?sample=dragon_res4&looks=0";
const positions = dragonPositions("_res4");

/** The package's own answer for the page's viewpoint. */
async function expected({ viewpoint }: Status, options: VisibilityOptions) {
  const { count, radius, evaluations } = await inNode(positions, (cloud) => cloud.visibleFrom(viewpoint, options));
  return { visible: count, radius, evaluations };
}

test("the radius follows any of the rules, and by hand it stays fixed", async () => {
  const page = await openReady(SAMPLE);
  for (const rule of ["search", "opposite", "auto"] as const) {
    const name = { search: "Best of 6", opposite: "Paper’s rule", auto: "Automatic" }[rule];
    await page.getByRole("button", { name }).click();
    const now = await upToDate(page);
    expect(now).toMatchObject(await expected(now, { radius: rule }));
    expect(await page.getByRole("button", { name }).getAttribute("aria-pressed")).toBe("true");
  }
  const automatic = await status(page);
  await page.getByRole("button", { name: "By hand" }).click();
  const kept = await upToDate(page);
  expect(Math.abs(kept.exponent - automatic.exponent)).toBeLessThan(0.026);
  await page.getByLabel("Exponent", { exact: true }).fill("1.5");
  const byHand = await upToDate(page);
  expect(byHand).toMatchObject(await answerInNode(positions, byHand, { exponent: 1.5 }));
  // The mark on the track stays at the automatic radius. The track goes from 0 to 6.
  const mark = () =>
    page
      .locator(".slider:has(#exponent)")
      .evaluate((slider) => Number(getComputedStyle(slider).getPropertyValue("--mark")));
  await expect.poll(mark).toBeCloseTo(automatic.exponent / 6, 6);
});

test("while the camera moves the automatic radius replaces a slow rule", async () => {
  const page = await openReady(`${SAMPLE}&radius=search`);
  const before = await upToDate(page);
  expect(before.evaluations).toBe(6);
  const evaluations = await page.evaluateHandle(() => {
    const seen: string[] = [];
    const line = document.getElementById("status")!;
    new MutationObserver(() => seen.push(line.dataset["evaluations"]!)).observe(line, {
      attributeFilter: ["data-evaluations"],
    });
    return seen;
  });
  await drag(page, 120, 20);
  const after = await upToDate(page);
  expect(after.viewpoint).not.toEqual(before.viewpoint);
  expect(after).toMatchObject(await expected(after, { radius: "search" }));
  const seen = await evaluations.jsonValue();
  expect(seen.at(-1)).toBe("6");
  expect(seen).toContain("0");
});

test("a radius in the cloud's units is used as it is; if it is too small, a message says so and the automatic radius is used", async () => {
  const page = await openReady(`${SAMPLE}&view=0.1,0.2,0.3&radius=25`);
  expect(await upToDate(page)).toMatchObject(await expected(await status(page), { radius: 25 }));
  // The mark is at the automatic exponent, even if the first answer uses a radius by hand.
  const { exponent } = await inNode(positions, (cloud) => cloud.autoRadius([0.1, 0.2, 0.3]));
  const mark = () =>
    page
      .locator(".slider:has(#exponent)")
      .evaluate((slider) => Number(getComputedStyle(slider).getPropertyValue("--mark")));
  await expect.poll(mark).toBeCloseTo(exponent / 6, 6);
  const small = await openReady(`${SAMPLE}&view=0.1,0.2,0.3&radius=0.01`);
  const now = await upToDate(small);
  expect(now).toMatchObject(await expected(now, {}));
  expect(await small.locator("#message p").textContent()).toMatch(/do not suit this cloud or place.*radius/);
});

test("exponential flipping has its own parameter and no radius", async () => {
  const page = await openReady(SAMPLE);
  await unfold(page, "Method and viewpoints");
  await page.getByRole("radio", { name: "Exponential" }).check();
  const now = await upToDate(page);
  const automatic = await inNode(positions, (cloud) =>
    cloud.visibleFrom(now.viewpoint, { inversion: { exponential: "auto" } }),
  );
  expect(now.visible).toBe(automatic.count);
  const { exponential } = automatic.inversion as { exponential: number };
  expect(now.inversion).toBe(`exponential:${exponential}`);
  // Rules that would be refused cannot be chosen.
  for (const name of ["Best of 6", "By hand"]) expect(await page.getByRole("button", { name }).isDisabled()).toBe(true);
  expect(await page.getByLabel("Exponent", { exact: true }).isDisabled()).toBe(true);

  // The field holds log₁₀ of c in spacings. The automatic c is 0.07 spacings.
  await page.getByLabel("c in exp(c/d)").fill("-0.5");
  const larger = await upToDate(page);
  const c = Number(larger.inversion.split(":")[1]);
  expect(c / exponential).toBeCloseTo(10 ** -0.5 / 0.07, 2);
  expect(larger.visible).toBe(
    await inNode(positions, (cloud) => cloud.visibleFrom(larger.viewpoint, { inversion: { exponential: c } }).count),
  );
  await page.locator("#scale-auto").click();
  expect((await upToDate(page)).visible).toBe(now.visible);
});

test("flipping by a power starts at a value that sees pits as deep as the automatic radius does", async () => {
  const page = await openReady(SAMPLE);
  const { exponent } = await status(page);
  await unfold(page, "Method and viewpoints");
  await page.getByRole("radio", { name: "Power" }).check();
  const now = await upToDate(page);
  const power = Number(now.inversion.split(":")[1]);
  expect(power / (power - 1)).toBeCloseTo(2 * 10 ** exponent, 0);
  const count = (of: Status, gamma: number) =>
    inNode(positions, (cloud) => cloud.visibleFrom(of.viewpoint, { inversion: { power: gamma } }).count);
  expect(now.visible).toBe(await count(now, power));

  await page.getByLabel("γ in d^−γ").fill("0");
  const two = await upToDate(page);
  expect(two.inversion).toBe("power:2");
  expect(two.visible).toBe(await count(two, 2));
});

test("several viewpoints give the union, or the points that two of them see", async () => {
  const page = await openReady(SAMPLE);
  await unfold(page, "Method and viewpoints");
  const one = await status(page);
  const five = (viewpoint: number[]) => [
    viewpoint,
    ...ringOfViewpoints(viewpoint, middleOf(positions), { count: 4, fraction: 0.05 }),
  ];

  await page.getByRole("radio", { name: "Any of 5" }).check();
  const any = await upToDate(page);
  expect(any.visible).toBe(await inNode(positions, (cloud) => cloud.visibleFromAny(five(any.viewpoint)).count));
  expect(any.visible).toBeGreaterThan(one.visible);

  await page.getByRole("radio", { name: "At least 2" }).check();
  await drag(page, 60, 0);
  const two = await upToDate(page);
  expect(two.viewpoint).not.toEqual(any.viewpoint);
  expect(two.visible).toBe(await inNode(positions, (cloud) => cloud.visibleFromAtLeast(2, five(two.viewpoint)).count));
});

test("noise is smoothed and voted on", async () => {
  const page = await openReady(SAMPLE);
  await unfold(page, "Noise");
  await page.locator("#denoise").getByRole("radio", { name: "16" }).check();
  const denoised = await upToDate(page);
  expect(denoised).toMatchObject(await expected(denoised, { denoise: 16 }));
  await page.locator("#vote").getByRole("radio", { name: "6", exact: true }).check();
  const voted = await upToDate(page);
  expect(voted.visible).not.toBe(denoised.visible);
  expect(voted).toMatchObject(await expected(voted, { denoise: 16, vote: 6 }));
});

test("a number of neighbors above the number of points gives a message, and nothing breaks", async () => {
  served.set("clouds/few.ply", asciiPly(ball(20)));
  const page = await openReady("?src=clouds/few.ply&denoise=32");
  expect((await reached(page, "ready")).total).toBe(20);
  expect(await page.locator("#message p").textContent()).toMatch(
    /do not suit this cloud .*: noise handling needs the 32 nearest neighbors of each point, and there are too few points\.$/,
  );
  // The section with the settings of the address is unfolded.
  await page.locator("#denoise").getByRole("radio", { name: "6", exact: true }).check();
  await upToDate(page);
  expect(await page.locator("#message").isVisible()).toBe(false);
});
