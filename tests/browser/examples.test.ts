// The examples that are pages print the lines in their comments. All but the plain one are bundled like users do.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { build } from "vite";
import { afterAll, beforeAll, expect, it } from "vitest";

import { promised, root } from "../package/snippets.js";
import { newPage } from "./browser.js";
import { serveModules } from "./modules.js";

const folder = join(root, "examples");
const OUT = "target/tests/examples";
const BUNDLED = ["three", "react", "deck"];

let site: Awaited<ReturnType<typeof serveModules>>;

beforeAll(async () => {
  site = await serveModules({});
  await build({
    root: folder,
    configFile: false,
    base: "./",
    logLevel: "error",
    build: {
      outDir: join(root, OUT),
      emptyOutDir: true,
      target: "es2022",
      chunkSizeWarningLimit: 5000,
      rolldownOptions: { input: BUNDLED.map((name) => join(folder, `${name}.html`)) },
    },
    worker: { format: "es" },
  });
});

afterAll(() => {
  site.close();
});

it.each([
  ["plain.html", "examples"],
  ["three.html", OUT],
  ["react.jsx", OUT],
  ["deck.html", OUT],
])("%s prints the lines in its comments", async (name, served) => {
  const page = await newPage();
  const [lines, failures]: string[][] = [[], []];
  page.on("console", (message) => message.type() === "log" && lines!.push(message.text()));
  page.on("pageerror", (error) => failures!.push(String(error)));
  await page.goto(`${site.address}${served}/${name.replace(".jsx", ".html")}`);
  const expected = promised(readFileSync(join(folder, name), "utf8"));
  expect(expected.length).toBeGreaterThan(0);
  await expect.poll(() => lines).toEqual(expected);
  expect(failures).toEqual([]);
  await page.close();
});
