import { expect, test } from "vitest";
import {
  differentPixels,
  drag,
  dragonPositions,
  inNode,
  openReady,
  picture,
  status,
  type Status,
  unfold,
  upToDate,
} from "./support.js";

const SAMPLE = "?sample=dragon_res4";
const positions = dragonPositions("_res4");

async function expected({ viewpoint }: Status, maxEdge?: number) {
  const { count, triangles } = await inNode(positions, (cloud) => cloud.reconstruct(viewpoint, { maxEdge }));
  return { visible: count, triangles: triangles.length / 3 };
}

test("the surface equals the library's, also while orbiting, and its edges can be longer", async () => {
  const page = await openReady(SAMPLE);
  const points = await picture(page);
  await unfold(page, "Surface");
  expect(await page.getByLabel("Longest edge").isDisabled()).toBe(true);
  await page.getByRole("radio", { name: "Surface" }).check();
  const surface = await upToDate(page);
  expect(surface.show).toBe("surface");
  expect(surface).toMatchObject(await expected(surface));
  expect(await differentPixels(page, points, await picture(page))).toBeGreaterThan(5000);
  expect(await page.locator("#surface-note").textContent()).toContain(
    new Intl.NumberFormat("en-US").format(surface.triangles!),
  );

  await drag(page, 150, 30);
  const orbited = await upToDate(page);
  expect(orbited.viewpoint).not.toEqual(surface.viewpoint);
  expect(orbited).toMatchObject(await expected(orbited));

  const usual = await picture(page);
  await page.getByLabel("Longest edge").press("End");
  const all = await upToDate(page);
  expect(all).toMatchObject(await expected(all, Infinity));
  expect(all.triangles).toBeGreaterThan(orbited.triangles!);
  expect(await page.locator("#edge-value").textContent()).toBe("all");
  expect(await differentPixels(page, usual, await picture(page))).toBeGreaterThan(500);

  await page.getByRole("radio", { name: "Points" }).check();
  const back = await upToDate(page);
  expect(back.show).toBe("points");
  expect(back.triangles).toBeUndefined();
});

test("an edge counts in spacings", async () => {
  const page = await openReady(`${SAMPLE}&show=surface&edge=2.5`);
  const now = await upToDate(page);
  const spacing = await inNode(
    positions,
    (cloud) =>
      (cloud.visibleFrom(now.viewpoint, { inversion: { exponential: "auto" } }).inversion as { exponential: number })
        .exponential / 0.07,
  );
  expect(now).toMatchObject(await expected(now, 2.5 * spacing));
});

test("a surface may have no triangle at all", async () => {
  const page = await openReady("?sample=bunny&show=surface&edge=0.2");
  expect(await upToDate(page)).toMatchObject({ state: "ready", triangles: 0 });
  await page.getByRole("radio", { name: "Points" }).check();
  expect(await upToDate(page)).toMatchObject({ state: "ready", show: "points", total: 1839 });
  expect(await page.locator("#tools").isVisible()).toBe(true);
});

test("a surface has one viewpoint: several viewpoints cannot be chosen", async () => {
  const page = await openReady(`${SAMPLE}&show=surface&viewpoints=any`);
  const now = await upToDate(page);
  expect(now).toMatchObject(await expected(now));
  expect(await page.getByRole("radio", { name: "Any of 5" }).isDisabled()).toBe(true);
  expect(await page.locator("#viewpoints-note").textContent()).toMatch(/one viewpoint/);
});

test("the camera can fly around a frozen surface, with the viewpoint marked", async () => {
  const page = await openReady(`${SAMPLE}&show=surface&theme=dark`);
  const before = await upToDate(page);
  await page.getByRole("button", { name: "Freeze viewpoint" }).click();
  await drag(page, 250, 0);
  const turned = await upToDate(page);
  expect(turned).toMatchObject({
    viewpoint: before.viewpoint,
    triangles: before.triangles,
    refilters: before.refilters,
  });
  // The camera moves back until the marker is in the picture. Only the marker has the accent color.
  const accent = async () => {
    const image = (await picture(page)).toString("base64");
    return page.evaluate(async (data) => {
      const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob());
      const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d")!;
      context.drawImage(bitmap, 0, 0);
      const { data: pixels } = context.getImageData(0, 0, bitmap.width, bitmap.height);
      let count = 0;
      for (let i = 0; i < pixels.length; i += 4) if (pixels[i]! > 200 && pixels[i + 2]! < 0.6 * pixels[i]!) count++;
      return count;
    }, image);
  };
  for (let step = 0; step < 12; step++) await page.locator("#view").press("-");
  await page.locator("#view").blur();
  expect(await accent()).toBeGreaterThan(20);
});

test("?freeze sets the frozen viewpoint, and ?view sets the camera", async () => {
  const page = await openReady(`${SAMPLE}&show=surface&freeze=0.1,0.2,0.3&view=-0.3,0.2,0.1`);
  const now = await upToDate(page);
  expect(now.viewpoint).toEqual([0.1, 0.2, 0.3]);
  expect(now).toMatchObject(await expected(now));
  expect(await page.getByRole("button", { name: "Unfreeze viewpoint" }).isVisible()).toBe(true);
  await page.getByRole("button", { name: "Unfreeze viewpoint" }).click();
  expect((await upToDate(page)).viewpoint).toEqual([-0.3, 0.2, 0.1]);
});

test("the airplane of rings hides what is behind its rings", async () => {
  const now = await status(await openReady("?sample=rings"));
  expect(now.total).toBe(2412);
  expect(now.visible).toBeGreaterThan(800);
  expect(now.visible).toBeLessThan(1700);
});
