// The examples of docs/EMBED.md: its elements in a foreign page.
import { afterAll, beforeAll, expect, test } from "vitest";
import { blocks, promised } from "../package/snippets.js";
import { asciiPly, ball } from "./clouds.js";
import { servePage, type Site } from "./site.js";
import { element, openStranger, settledState } from "./stranger.js";
import { inNode, served } from "./support.js";

const SCAN = "https://example.org/viewer/";
const [simple, styled] = blocks("docs/EMBED.md", "html");
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
