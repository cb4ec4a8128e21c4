// The demo page as a camera: it is opened by its address, and photographed when its picture is up to date.
import type { Browser, BrowserContextOptions, Page } from "playwright-core";

import { hideControls, launchBrowser, servePage, type Site } from "../browser/site.js";

/** The parameters of the page's address. Several values of one parameter follow one another. */
export type Query = Record<string, string | number | readonly string[]>;

export interface Shot {
  png: Buffer;
  /** The data-* attributes of the page's status line. */
  status: Partial<Record<string, string>>;
}

export interface Size {
  width: number;
  height: number;
}

/** Software rendering of large clouds on a busy machine is slow. This limit only ends pages that hang. */
const PATIENCE = 240_000;

export class Studio {
  readonly #site: Site;
  readonly #browser: Browser;
  readonly #files: Map<string, Uint8Array>;

  private constructor(site: Site, browser: Browser, files: Map<string, Uint8Array>) {
    this.#site = site;
    this.#browser = browser;
    this.#files = files;
  }

  static async open(): Promise<Studio> {
    const files = new Map<string, Uint8Array>();
    return new Studio(await servePage(files), await launchBrowser(), files);
  }

  async close(): Promise<void> {
    await this.#browser.close();
    this.#site.close();
  }

  /** Puts a file beside the page, for `src`. */
  serve(name: string, bytes: Uint8Array): void {
    this.#files.set(name, bytes);
  }

  /** A picture of the page's canvas. A message of the page is an error. */
  async shoot(query: Query, size: Size): Promise<Shot> {
    const entries = Object.entries(query).flatMap(([name, value]) => [value].flat().map((one) => [name, String(one)]));
    // The paper has one hull.
    const looks = "looks" in query ? [] : [["looks", "0"]];
    const address = `?${new URLSearchParams([...entries, ...looks]).toString()}`;
    return this.#withPage(size, async (page) => {
      await hideControls(page);
      await page.goto(this.#site.address + address);
      await page
        .locator('#status:is([data-state="ready"][data-busy="0"], [data-state="error"])')
        .waitFor({ state: "attached", timeout: PATIENCE });
      const message = page.locator("#message");
      if (await message.isVisible()) throw new Error(`The page says of ${address}: ${await message.innerText()}`);
      await twoFrames(page);
      const status = await page
        .locator("#status")
        .evaluate((element: HTMLElement) => Object.fromEntries(Object.entries(element.dataset)));
      return { png: await page.locator("#view").screenshot({ timeout: PATIENCE }), status };
    });
  }

  /** A picture of the body of a new page with `html`, after `prepare` has finished it. */
  async print(
    html: string,
    width: number,
    prepare: (page: Page) => Promise<void> = () => Promise.resolve(),
  ): Promise<Buffer> {
    return this.#withPage({ width, height: 100 }, async (page) => {
      await page.setContent(html);
      await prepare(page);
      return page.locator("body").screenshot();
    });
  }

  /** A picture of the whole page, as visitors see it. */
  async visit(query: string, options: BrowserContextOptions, use: (page: Page) => Promise<void>): Promise<void> {
    const context = await this.#browser.newContext(options);
    try {
      const page = await context.newPage();
      await page.goto(this.#site.address + query);
      await page
        .locator('#status[data-state="ready"][data-busy="0"]')
        .waitFor({ state: "attached", timeout: PATIENCE });
      await use(page);
    } finally {
      await context.close();
    }
  }

  async #withPage<T>(viewport: Size, use: (page: Page) => Promise<T>): Promise<T> {
    const page = await this.#browser.newPage({ viewport });
    const errors: string[] = [];
    page.on("pageerror", (error) => errors.push(String(error)));
    try {
      const result = await use(page);
      if (errors.length > 0) throw new Error(errors.join("\n"));
      return result;
    } finally {
      await page.close();
    }
  }
}

/** The first frame may still show the previous picture. */
async function twoFrames(page: Page): Promise<void> {
  await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
}
