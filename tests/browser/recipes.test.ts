// The recipes that need a page. Each is bundled like users do, and prints the lines in its comments.
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import type { Browser } from "playwright-core";
import { afterAll, beforeAll, expect, it, vi } from "vitest";

import { blocks, promised, root } from "../package/snippets.js";
import { builtFrom } from "./built.js";
import { serveModules } from "./modules.js";
import { launchBrowser } from "./site.js";

let browser: Browser;
let site: Awaited<ReturnType<typeof serveModules>>;

beforeAll(async () => {
  browser = await launchBrowser();
  site = await serveModules({});
});

afterAll(async () => {
  await browser.close();
  site.close();
});

it.each(blocks("docs/RECIPES.md", "jsx").map((code, i) => [i, code] as const))(
  "page %i prints the lines in its comments",
  async (i, code) => {
    const source = join(root, "target/recipes", `page-${i}`);
    mkdirSync(source, { recursive: true });
    writeFileSync(join(source, "page.jsx"), code);
    const html =
      '<link rel="icon" href="data:,"><div id="root" style="height: 300px"></div><script type="module" src="./page.jsx"></script>';
    writeFileSync(join(source, "index.html"), `<!doctype html>${html}`);
    const path = await builtFrom(source, `recipe-${i}`);

    const page = await browser.newPage();
    const [lines, failures]: string[][] = [[], []];
    page.on("console", (message) => message.type() === "log" && lines!.push(message.text()));
    page.on("pageerror", (error) => failures!.push(String(error)));
    await page.goto(site.address + path);
    await vi.waitFor(
      () => {
        expect(lines).toEqual(promised(code));
      },
      { timeout: 60_000 },
    );
    expect(failures).toEqual([]);
    await page.close();
  },
);
