// Pages that cannot load a file of the package. The error names the file and the ways out.
import { type Browser, type Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";

import { launchBrowser } from "../browser/site";
import { consumers, installPacked } from "./install";
import { html, serve } from "./serve";
import { visitWith } from "./visit";

let browser: Browser;

beforeAll(async () => {
  installPacked();
  browser = await launchBrowser();
});
afterAll(() => browser.close());

const PAGE = html('<script type="module" src="projects/pages/relative.js"></script>');

async function visit(options: Parameters<typeof serve>[1] = {}, prepare?: (page: Page) => Promise<unknown>) {
  await using site = await serve(consumers, { ...options, pages: { "index.html": PAGE } });
  return { ...(await visitWith(browser, `${site.address}index.html`, prepare)), address: site.address };
}

const WASM = "**/*.wasm";

describe("the wasm", () => {
  const faults: [name: string, says: RegExp, prepare: (page: Page) => Promise<unknown>][] = [
    ["is missing", /404/, (page) => page.route(WASM, (route) => route.fulfill({ status: 404, body: "nothing" }))],
    // Some servers answer every request with the page of an application.
    [
      "is a page",
      /magic/,
      (page) => page.route(WASM, (route) => route.fulfill({ contentType: "text/html", body: PAGE })),
    ],
    [
      "is a page served with the type of wasm",
      /magic/,
      (page) => page.route(WASM, (route) => route.fulfill({ contentType: "application/wasm", body: PAGE })),
    ],
    ["cannot be reached", /fetch/, (page) => page.route(WASM, (route) => route.abort("internetdisconnected"))],
  ];
  it.each(faults)("%s: load, with its address and the ways out", async (_, says, prepare) => {
    const { error, address } = await visit({}, prepare);
    expect(error).toMatch(/^load: /);
    expect(error).toMatch(says);
    expect(error).toContain(`${address}node_modules/hidden-point-removal/dist/wasm/hpr_bg.wasm`);
    for (const wayOut of ["hidden-point-removal/hpr.wasm", "init()", "hidden-point-removal/inline"]) {
      expect(error).toContain(wayOut);
    }
  });

  it("is forbidden by the page's security policy: load", async () => {
    const { error } = await visit({ headers: { "content-security-policy": "default-src 'self'" } });
    expect(error).toMatch(/^load: .*Content Security Policy.*'wasm-unsafe-eval'/s);
  });

  it("is served with a wrong type: works all the same", async () => {
    const { error, here } = await visit({}, (page) =>
      page.route(WASM, async (route) => route.fulfill({ response: await route.fetch(), contentType: "text/plain" })),
    );
    expect(error).toBeUndefined();
    expect(here!.length).toBeGreaterThan(100);
  });
});

describe("the worker", () => {
  it("has no script: load, with its address and the way out", async () => {
    const { error, address } = await visit({ refused: /worker-thread\.js$/ });
    expect(error).toMatch(/^load: the worker could not be started/);
    expect(error).toContain(`${address}node_modules/hidden-point-removal/dist/worker-thread.js`);
    for (const wayOut of [
      "hidden-point-removal/worker-thread.js",
      "configure({ worker })",
      "hidden-point-removal/inline",
    ]) {
      expect(error).toContain(wayOut);
    }
  });

  it("is forbidden by the page's security policy: load", async () => {
    const policy = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'none'";
    const { error } = await visit({ headers: { "content-security-policy": policy } });
    expect(error).toMatch(/^load: the worker could not be started/);
  });
});
