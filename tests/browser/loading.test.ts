import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { expect, test } from "vitest";
import { root } from "../root.js";
import { newContext } from "./browser.js";
import { openPage, PHONE, reached, site, upToDate } from "./support.js";

/** A sample that is downloaded, and small. */
const SMALL = "?sample=bunny";

/** The bytes of a response. Files that are already compressed are sent as they are. Others are compressed first. */
function onTheWire(name: string): number {
  const bytes = readFileSync(join(root, "www", "dist", name || "index.html"));
  return /\.avif$/.test(name) ? bytes.length : gzipSync(bytes, { level: 9 }).length;
}

test("the download for the first cloud, with three.js, wasm and workers, is at most 395 kB", async () => {
  const context = await newContext();
  const page = await context.newPage();
  // The time of the first answer. The first cloud does not wait for later requests.
  await page.addInitScript(() => {
    addEventListener("DOMContentLoaded", () => {
      const element = document.getElementById("status")!;
      new MutationObserver((_, observer) => {
        if (element.dataset["state"] !== "ready") return;
        observer.disconnect();
        performance.mark("first cloud");
      }).observe(element, { attributes: true });
    });
  });
  const from = site.asked.length;
  await page.goto(site.address + SMALL);
  await reached(page, "ready");
  await page.waitForFunction(() => document.querySelectorAll("#thumbnails img[src]").length > 0);
  const later = await page.evaluate(() => {
    const [{ startTime: ready }] = performance.getEntriesByName("first cloud") as [PerformanceEntry];
    return performance
      .getEntriesByType("resource")
      .filter(({ startTime }) => startTime >= ready)
      .map(({ name }) => name);
  });
  const asked = site.asked
    .slice(from)
    .filter((name) => !name.startsWith("samples/") && !later.includes(site.address + name));
  for (const name of asked) expect(existsSync(join(root, "www", "dist", name || "index.html")), name).toBe(true);
  const table = asked.map((name) => ({ file: name || "index.html", bytes: onTheWire(name) }));
  console.table(table);
  const total = table.reduce((sum, { bytes }) => sum + bytes, 0);
  console.log(`${total} bytes before the first cloud is on screen`);
  expect(new Set(asked).size).toBe(asked.length);
  expect(asked.some((name) => name.endsWith(".wasm"))).toBe(true);
  // 158 kB of it are the wasm, 127 kB are three.js.
  expect(total).toBeLessThanOrEqual(395_000);
  await context.close();
});

test.for([{ viewport: { width: 1280, height: 800 } }, PHONE])(
  "nothing shifts while the page loads ($viewport.width px)",
  async (options) => {
    // The observer must run before anything is drawn.
    const observe = () => {
      const shifts: { value: number; what: string[] }[] = [];
      Object.assign(window, { shifts });
      new PerformanceObserver((list) => {
        for (const entry of list.getEntries() as (PerformanceEntry & {
          value: number;
          sources: { node: Node | null }[];
        })[]) {
          shifts.push({
            value: entry.value,
            what: entry.sources.map(({ node }) =>
              node instanceof Element ? node.id || node.tagName : String(node?.nodeName),
            ),
          });
        }
      }).observe({ type: "layout-shift", buffered: true });
    };
    const page = await openPage(SMALL, options, async (fresh) => {
      await fresh.addInitScript(observe);
    });
    await reached(page, "ready");
    await upToDate(page);
    await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
    const shifts = await page.evaluate(
      () => (window as unknown as { shifts: { value: number; what: string[] }[] }).shifts,
    );
    const sum = shifts.reduce((total, { value }) => total + value, 0);
    expect(sum, JSON.stringify(shifts)).toBeLessThan(0.02);
  },
);

test("the cloud and the WebAssembly are asked for before the part of the page that draws has run", async () => {
  const page = await openPage("?sample=dragon_res4", {}, async (opened) => {
    await opened.addInitScript(() => {
      type Methods = Record<string, (...given: unknown[]) => unknown>;
      const before = (methods: Methods, name: string, note: (first: unknown) => void) => {
        const own = methods[name]!;
        methods[name] = function (this: unknown, ...given: unknown[]) {
          note(given[0]);
          return own.apply(this, given);
        };
      };
      before(HTMLCanvasElement.prototype as unknown as Methods, "getContext", () => performance.mark("context"));
    });
  });
  await reached(page, "ready");
  const begun = await page.evaluate(() => {
    const { startTime: drawn } = performance.getEntriesByName("context")[0]!;
    return performance
      .getEntriesByType("resource")
      .filter(({ startTime }) => startTime < drawn)
      .map(({ name }) => name);
  });
  for (const name of ["/assets/hpr_bg-", "/assets/session-", "/samples/dragon_res4.bin"]) {
    expect(begun.filter((address) => address.includes(name))).not.toEqual([]);
  }
});
