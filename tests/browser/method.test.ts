import type { VisibilityOptions } from "hidden-point-removal";
import { expect, test } from "vitest";
import {
  addressWritten,
  dragonPositions,
  inNode,
  openReady,
  settled,
  site,
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

test("the page says what looks take the cloud to be, and a person can change it", async () => {
  const page = await openReady("?sample=dragon_res3");
  await page.locator('#status[data-surface="clean"]').waitFor({ state: "attached" });
  await unfold(page, "Advanced");
  const found = page.locator("#sheet .found");
  expect(await found.textContent()).toBe("A clean surface.");
  const before = await upToDate(page);
  await page.locator("#surface").getByRole("radio", { name: "Noisy" }).check();
  await page.locator('#status[data-surface="noisy"]').waitFor({ state: "attached" });
  const noisy = await settled(page);
  const expected = await inNode(dragonPositions("_res3"), (cloud) =>
    cloud.visibleFrom(before.viewpoint, { looks: 3, surface: "noisy" }),
  );
  expect(noisy.visible).toBe(expected.count);
  expect((await addressWritten(page)).get("surface")).toBe("noisy");
  await page.goto(`${site.address}?sample=dragon_res3&surface=layered&thickness=0.004`);
  await page.locator('#status[data-surface="layered"]').waitFor({ state: "attached" });
  expect(await found.textContent()).toBe(
    "A layered scan; points up to about 0.004\u00a0units behind a surface are shown.",
  );
});

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
