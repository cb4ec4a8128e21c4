// Marks and stations in the address.
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { addressWritten, drag, openPage, openReady, PHONE, served, site, upToDate } from "./support.js";

const tool = (page: Page, name: string) => page.locator("#tool-bar").getByRole("button", { name });

/** All marks. */
async function marks(page: Page) {
  return {
    measures: await page.locator("#marks .measure text").allTextContents(),
    labels: await page.locator("#label-list li span").allTextContents(),
    stations: await page.locator("#stations-card .list span").allTextContents(),
  };
}

/** Clicks at places around the middle of the picture. */
async function click(page: Page, ...places: [number, number][]): Promise<void> {
  const box = (await page.locator("#view").boundingBox())!;
  for (const [x, y] of places) await page.mouse.click(box.x + box.width / 2 + x, box.y + box.height / 2 + y);
}

test("a link has the distances, labels and stations, and opens with them", async () => {
  const page = await openReady("?sample=bunny&size=1.4");
  await tool(page, "Measure").click();
  await click(page, [-40, 0], [40, 10]);
  await page.locator("#marks .measure").waitFor({ state: "attached" });
  await tool(page, "Label").click();
  await click(page, [0, 20]);
  await page.locator("#label-text").fill("Ear, left & “<b>”");
  await page.locator("#label-text").press("Enter");
  await tool(page, "Stations").click();
  await page.getByRole("button", { name: "At the camera" }).click();
  await page.locator("#stations-unseen[data-count]").waitFor({ state: "attached" });
  const before = await marks(page);
  expect(before).toEqual({
    measures: [expect.stringContaining("units")],
    labels: ["Ear, left & “<b>”"],
    stations: ["S1"],
  });
  const query = await addressWritten(page);
  expect([...query.keys()]).toEqual(["sample", "size", "measure", "label", "station"]);

  const again = await openReady(`?${query.toString()}`);
  await expect.poll(() => marks(again)).toEqual(before);
  expect((await addressWritten(again)).toString()).toBe(query.toString());
  expect(await again.locator("#message").isVisible()).toBe(false);

  // What is removed is no longer in the address.
  await tool(page, "Measure").click();
  await page.locator("#measure-clear").click();
  expect([...(await addressWritten(page)).keys()]).toEqual(["sample", "size", "label", "station"]);
  // Marks do not go to the next cloud.
  await page.locator("#sample").selectOption("dragon_res4");
  await page.locator('#status[data-total="5205"]').waitFor();
  expect([...(await addressWritten(page)).keys()]).toEqual(["sample"]);
});

test("the code for another page shows the present view: the package and the element have the same answer", async () => {
  const page = await openReady("?sample=bunny&view=1,8,-12&target=0,5,0&fov=30&size=1.4&exponent=2", {
    permissions: ["clipboard-read", "clipboard-write"],
  });
  const { visible, viewpoint } = await upToDate(page);
  await tool(page, "Export").click();
  await page.locator("#export-card .use").click();
  const copied = async (name: string) => {
    await page.getByRole("button", { name: `Copy ${name}` }).click();
    await page.locator("#use output", { hasText: "Copied." }).waitFor();
    return page.evaluate(() => navigator.clipboard.readText());
  };
  const [, from, options] = /visibleFrom\((\[.*?\]), \{ (.*) \}\);$/.exec(await copied("npm package"))!;
  expect(JSON.parse(from!)).toEqual(viewpoint);
  expect(options).toBe("exponent: 2");
  const three = await copied("three.js");
  expect(three).toContain(`camera.position.set(${viewpoint.join(", ")});\ncamera.lookAt(0, 5, 0);`);
  expect(three).toContain("new HiddenPointFilter(points, { exponent: 2 });");
  const code = await copied("HTML element");
  const [script, element] = code.split("\n");
  expect(script).toBe(`<script type="module" src="${site.address}hidden-point-cloud.js"></script>`);
  served.set("other.html", new TextEncoder().encode(`<!doctype html><link rel="icon" href="data:," />${code}`));
  await page.goto(`${site.address}other.html`);
  const shown = await page.evaluate(async () => {
    const found = document.querySelector("hidden-point-cloud") as HTMLElement & {
      ready: Promise<void>;
      visibleCount: number;
      viewpoint: number[];
    };
    await customElements.whenDefined("hidden-point-cloud");
    await found.ready;
    return { visible: found.visibleCount, viewpoint: found.viewpoint };
  });
  expect(shown, element).toEqual({ visible, viewpoint });
});

test("on a phone with the tools open, the address opens exactly the same picture", async () => {
  const page = await openReady("?sample=bunny&measure=5,1000", PHONE);
  await drag(page, 40, 30);
  const end = (opened: Page) =>
    opened
      .locator("#marks .measure .dot")
      .first()
      .evaluate((dot) => {
        const { x, y } = dot.getBoundingClientRect();
        return [x, y].map(Math.round);
      });
  const query = await addressWritten(page);
  const again = await openReady(`?${query.toString()}`, PHONE);
  await again.locator("#marks .measure .dot").first().waitFor({ state: "attached" });
  await expect.poll(() => end(again)).toEqual(await end(page));
});

test("marks that do not suit the cloud are left out, and a sentence says so", async () => {
  const page = await openReady("?sample=bunny&measure=1,2&measure=1,9999&label=5,Nose&label=x,Y&station=1,2,North");
  await expect.poll(() => page.locator("#message p").textContent()).toMatch(/^Some marks or stations in the address/);
  expect(await marks(page)).toMatchObject({ measures: [expect.any(String)], labels: ["Nose"], stations: [] });
  expect((await addressWritten(page)).toString()).toBe("sample=bunny&measure=1%2C2&label=5%2CNose");
});

test("the marks of a file that cannot be opened do not go to the sample that replaces it", async () => {
  served.set("clouds/empty.xyz", new Uint8Array());
  const page = await openPage("?src=clouds/empty.xyz&measure=1,2");
  await page.locator("#tools:not([inert])").waitFor();
  await upToDate(page);
  expect((await marks(page)).measures).toEqual([]);
});
