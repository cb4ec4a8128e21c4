// The examples of docs/EMBED.md: its elements and its frame in a foreign page.
import { afterAll, beforeAll, expect, test } from "vitest";
import { blocks, promised } from "../package/snippets.js";
import { asciiPly, ball } from "./clouds.js";
import { servePage, type Site } from "./site.js";
import { element, openStranger, settledState } from "./stranger.js";
import { inNode, openPage, provoke, reached, served, status } from "./support.js";

const SCAN = "https://example.org/viewer/";
const [simple, styled, framed] = blocks("docs/EMBED.md", "html");
const [script] = blocks("docs/EMBED.md", "js");
const positions = ball(900);

let elsewhere: Site;

beforeAll(async () => {
  const extra = new Map([["samples/scan.ply", asciiPly(positions)]]);
  elsewhere = await servePage(extra, { "access-control-allow-origin": "*" });
  served.set("scan.ply", asciiPly(positions));
});

afterAll(() => {
  elsewhere.close();
});

/** The HTML of the document, without the module, which `openStranger` adds. */
function body(html: string): string {
  return html
    .replace(/<script.*<\/script>/, "")
    .replace("<hidden-point-cloud ", '<hidden-point-cloud id="scan" ')
    .replaceAll(SCAN, elsewhere.address);
}

test("the first element and its script print the lines in their comments", async () => {
  const page = await openStranger(elsewhere.address, body(simple!));
  expect(await settledState(page, "scan")).toBe("ready");
  const lines: string[] = [];
  page.on("console", (message) => message.type() === "log" && lines.push(message.text()));
  served.set("snippet.js", Buffer.from(script!));
  await page.addScriptTag({ url: "snippet.js", type: "module" });
  await expect.poll(() => lines).toEqual(promised(script!));
  await expect.poll(() => element(page, "scan", ({ viewpoint }) => viewpoint)).toEqual([6, 6, 1]);

  const answer = await element(page, "scan", ({ exponent, hiddenPoints, visibleCount }) => [
    exponent,
    hiddenPoints,
    visibleCount,
  ]);
  await page.reload();
  expect(await settledState(page, "scan")).toBe("ready");
  const from = await element(page, "scan", ({ viewpoint }) => viewpoint!);
  const count = await inNode(positions, (cloud) => cloud.visibleFrom(from, { exponent: 3 }).count);
  // The viewpoint was frozen before the camera moved.
  expect(answer).toEqual([3, "dimmed", count]);
});

test("its style and its slots are the page's", async () => {
  const page = await openStranger(elsewhere.address, body(styled!));
  expect(await settledState(page, "scan")).toBe("ready");
  expect(await page.locator("#scan").evaluate((cloud) => cloud.getBoundingClientRect().height)).toBeCloseTo(420, 0);
  expect(await page.getByText("A scan of the hall").isVisible()).toBe(false);
  // The background of the picture is the page's color, too.
  const corner = await element(page, "scan", async (cloud) => {
    const bitmap = await createImageBitmap(await cloud.toBlob());
    const context = new OffscreenCanvas(1, 1).getContext("2d")!;
    context.drawImage(bitmap, 0, 0);
    return [...context.getImageData(0, 0, 1, 1).data];
  });
  expect(corner).toEqual([0x20, 0x24, 0x2b, 255]);
  await element(page, "scan", (cloud) => {
    cloud.src = "http://[";
  });
  await page.getByText("The scan is not available.").waitFor();
  expect(await page.getByText("One moment").isVisible()).toBe(false);
});

test("the keys work in the frame, and the page around still scrolls", async () => {
  served.set(
    "framed.html",
    Buffer.from(
      `<!doctype html><html lang="en"><head><title>Framed</title><link rel="icon" href="data:,"></head><body>${body(framed!)}<div style="height: 3000px"></div></body></html>`,
    ),
  );
  const page = await openPage("framed.html");
  const frame = page.frameLocator("iframe");
  const told = frame.locator("#status");
  await frame.locator('#status[data-state="ready"]').waitFor({ state: "attached" });
  const viewpoint = () => told.getAttribute("data-viewpoint");
  const first = await viewpoint();
  expect(await told.getAttribute("data-total")).toBe("900");

  await page.mouse.move(400, 200);
  await page.mouse.wheel(0, 100);
  await expect.poll(() => page.evaluate(() => scrollY)).toBeGreaterThan(50);
  expect(await viewpoint()).toBe(first);
  await page.evaluate(() => {
    scrollTo(0, 0);
  });
  await page.mouse.click(400, 200);
  await page.mouse.wheel(0, 100);
  await expect.poll(viewpoint).not.toBe(first);
  expect(await page.evaluate(() => scrollY)).toBe(0);
  const zoomed = await viewpoint();
  await page.keyboard.press("ArrowLeft");
  await expect.poll(viewpoint).not.toBe(zoomed);
  await expect.poll(() => frame.getByRole("status").textContent()).toMatch(/of 900 points/);
  expect(await frame.getByRole("link", { name: "Whole page" }).isVisible()).toBe(true);
});

test("a frame whose file cannot be opened shows only the error, and no sample instead", async () => {
  provoke(/404/);
  const page = await openPage("?src=clouds/missing.ply&embed=1");
  const { sentence, total } = await reached(page, "error");
  expect(sentence).toMatch(/missing\.ply could not be downloaded/);
  expect(await page.locator("#message p").textContent()).toBe(sentence);
  await page.waitForTimeout(500);
  expect(total).toBeUndefined();
  expect(await reached(page, "error")).toMatchObject({ sentence });
  expect((await status(page)).total).toBeUndefined();
});
