import type { VisibilityOptions } from "hidden-point-removal";
import { expect, test } from "vitest";
import { dragonPositions, inNode, openReady, status, type Status, unfold, upToDate } from "./support.js";

const SAMPLE = "?sample=dragon_res4&looks=0";
const positions = dragonPositions("_res4");

/** The package's own answer for the page's viewpoint. */
async function expected({ viewpoint }: Status, options: VisibilityOptions) {
  const { count, radius, evaluations } = await inNode(positions, (cloud) => cloud.visibleFrom(viewpoint, options));
  return { visible: count, radius, evaluations };
}

test("a radius in the cloud's units is used as it is; if it is too small, a message says so and the automatic radius is used", async () => {
  const page = await openReady(`${SAMPLE}&view=0.1,0.2,0.3&radius=25`);
  expect(await upToDate(page)).toMatchObject(await expected(await status(page), { radius: 25 }));
  const small = await openReady(`${SAMPLE}&view=0.1,0.2,0.3&radius=0.01`);
  const now = await upToDate(small);
  expect(now).toMatchObject(await expected(now, {}));
  expect(await small.locator("#message p").textContent()).toMatch(/do not suit this cloud or place.*radius/);
});

test("exponential flipping has no radius, and its c counts in spacings", async () => {
  const page = await openReady(`${SAMPLE}&inversion=exponential`);
  const now = await upToDate(page);
  const automatic = await inNode(positions, (cloud) =>
    cloud.visibleFrom(now.viewpoint, { inversion: { exponential: "auto" } }),
  );
  const { exponential } = automatic.inversion as { exponential: number };
  expect(now).toMatchObject({ visible: automatic.count, inversion: `exponential:${exponential}` });
  await unfold(page, "Advanced");
  expect(await page.getByLabel("Exponent", { exact: true }).isDisabled()).toBe(true);

  const larger = await upToDate(await openReady(`${SAMPLE}&inversion=exponential:0.3`));
  const c = Number(larger.inversion.split(":")[1]);
  expect(c / exponential).toBeCloseTo(0.3 / 0.07, 2);
  expect(larger.visible).toBe(
    await inNode(positions, (cloud) => cloud.visibleFrom(larger.viewpoint, { inversion: { exponential: c } }).count),
  );
});
