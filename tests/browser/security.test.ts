// The page's security policy, names that look like markup, and where requests go.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { root } from "../root.js";
import { ball, rows, text } from "./clouds.js";
import { choose } from "./files.js";
import { servePage } from "./site.js";
import { answered, drag, openPage, openReady, provoke, reached, site, status, upToDate, unfold } from "./support.js";

const POINTS = text(
  rows(ball(60))
    .map((point) => point.join(" "))
    .join("\n"),
);
const MARKUP = `<img src=x onerror="window.hacked=1"><script>window.hacked=1</script>`;
/** Right-to-left override: the text after it would be shown backwards. */
const BIDI = "ply.\u202Eexe.txt";
const LONG = "long".repeat(60);

/** The policy of the built page. */
function policy(): string {
  const page = readFileSync(join(root, "www", "dist", "index.html"), "utf8");
  return /http-equiv="Content-Security-Policy" content="([^"]+)"/.exec(page)![1]!;
}

/** The number of elements that markup in a name would add. */
const added = (page: Page) =>
  page.locator("img:not([src^='./']):not([src^='thumbnails']), script:not([src]), iframe").count();
/** The width of the page minus the width of the window, in pixels. */
const overflow = (page: Page) =>
  page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
const hacked = (page: Page) => page.evaluate(() => "hacked" in window);

test("the policy allows only the page's own scripts and its own inline script", async () => {
  const rules = new Map(
    policy()
      .split("; ")
      .map((rule) => [rule.split(" ")[0]!, rule.split(" ").slice(1)]),
  );
  expect(rules.get("default-src")).toEqual(["'none'"]);
  expect(rules.get("script-src")!.filter((source) => !source.startsWith("'sha256-"))).toEqual([
    "'self'",
    "'wasm-unsafe-eval'",
  ]);
  expect([...rules.values()].flat()).not.toContain("'unsafe-inline'");
  expect([...rules.values()].flat()).not.toContain("'unsafe-eval'");

  const page = await openReady("?sample=bunny");
  provoke(/security policy|Content Security Policy|404/);
  const refused = await page.evaluate(async (markup) => {
    const directives = new Set<string>();
    document.addEventListener("securitypolicyviolation", ({ effectiveDirective }) =>
      directives.add(effectiveDirective),
    );
    const script = document.createElement("script");
    script.textContent = "window.hacked = 1";
    const holder = document.createElement("div");
    holder.innerHTML = markup;
    const frame = document.createElement("iframe");
    frame.src = "./";
    document.body.append(script, holder, frame);
    // If the event never comes, the test ends by its time limit.
    while (directives.size < 3) await new Promise((next) => setTimeout(next, 50));
    // The policy does not apply to the test's own calls, but to code after a timer.
    try {
      (0, eval)("window.hacked = 1");
    } catch (error) {
      directives.add((error as Error).name);
    }
    return [...directives].sort();
  }, MARKUP);
  expect(refused).toEqual(["EvalError", "frame-src", "script-src-attr", "script-src-elem"]);
  expect(await hacked(page)).toBe(false);
});

test("a host may send the policy as a header, for workers too", async () => {
  // The reader of LAZ is a WebAssembly module of its own.
  const laz = readFileSync(join(root, "tests/browser/fixtures/ball-12.laz"));
  const strict = await servePage(new Map([["cloud.laz", laz]]), { "content-security-policy": policy() });
  try {
    await openPage("?sample=bunny", {}, async (fresh) => {
      for (const query of ["?sample=bunny", "?src=cloud.laz"]) {
        await fresh.goto(strict.address + query);
        expect((await reached(fresh, "ready")).total, query).toBeGreaterThan(100);
      }
    });
  } finally {
    strict.close();
  }
});

test("a file's name stays text: markup, a change of direction, great length", async () => {
  const page = await openReady("?sample=bunny");
  const before = await added(page);
  for (const name of [MARKUP.replaceAll("/", "∕"), BIDI, LONG]) {
    await choose(page, `${name}.xyz`, POINTS);
    await expect.poll(() => page.locator("#panel .credit").textContent()).toContain(`${name}.xyz`);
    // The message names a file that cannot be read.
    await choose(page, `${name}.pdf`, Buffer.from("%PDF-1.7\n\u0000"));
    await expect.poll(() => page.locator("#message p").textContent()).toContain(name.slice(0, 20));
    expect(await added(page)).toBe(before);
    expect(await hacked(page)).toBe(false);
    expect(await overflow(page)).toBeLessThanOrEqual(0);
  }
});

test("attributes' names stay text", async () => {
  const page = await openReady("?sample=bunny");
  const before = await added(page);
  const names = [MARKUP.replaceAll(/[\s,]/g, ""), BIDI, LONG];
  const rows = Array.from({ length: 60 }, (_, i) => [Math.cos(i), Math.sin(i), i / 60, i, 2 * i, 3 * i].join(","));
  const now = await status(page);
  await choose(page, "names.csv", Buffer.from([`x,y,z,${names.join(",")}`, ...rows].join("\n")));
  await answered(page, now);
  await unfold(page, "Look");
  const labels = await page.locator("#color option").allTextContents();
  // The first letter is made a capital.
  for (const name of names) {
    expect(labels.filter((label) => label.slice(1) === name.slice(1))).toHaveLength(1);
  }
  for (const label of labels) {
    await page.locator("#color").selectOption({ label });
    await upToDate(page);
  }
  expect(await added(page)).toBe(before);
  expect(await hacked(page)).toBe(false);
  expect(await overflow(page)).toBeLessThanOrEqual(0);
});

test("a whole session sends requests only to this site, and to the address of ?src", async () => {
  const requests: string[] = [];
  const note = (page: Page) => {
    page.context().on("request", (request) => requests.push(request.url()));
    return Promise.resolve();
  };
  const elsewhere = await servePage(new Map([["far.xyz", POINTS]]), {
    "access-control-allow-origin": "*",
  });
  try {
    const page = await openReady("?sample=bunny", {}, note);
    await drag(page, 60, 20);
    await upToDate(page);
    for (const key of ["c", "p", "m", "s", "e", "?"]) {
      await page.locator("#view").press(key);
    }
    await page.keyboard.press("Escape");
    await choose(page, "own.xyz", POINTS);
    await expect.poll(async () => (await status(page)).total).toBe(60);
    const own = (url: string) => url.startsWith(site.address) || url.startsWith("data:") || url.startsWith("blob:");
    expect(requests.length).toBeGreaterThan(10);
    expect(requests.filter((url) => !own(url))).toEqual([]);

    requests.length = 0;
    await openReady(`?src=${encodeURIComponent(`${elsewhere.address}far.xyz`)}`, {}, note);
    expect([...new Set(requests.filter((url) => !own(url)))]).toEqual([`${elsewhere.address}far.xyz`]);
  } finally {
    elsewhere.close();
  }
});

test("a name in the address stays text", async () => {
  const page = await openPage(`?sample=${encodeURIComponent(MARKUP)}`);
  await page.locator("#message").waitFor({ state: "visible" });
  expect(await hacked(page)).toBe(false);
  expect(await page.locator("#message img, #message script").count()).toBe(0);
});
