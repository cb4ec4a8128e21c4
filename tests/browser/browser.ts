import type { BrowserContext, BrowserContextOptions, Page } from "playwright-core";
import { launchBrowser } from "./site.js";

/** One browser for all test files of a worker of vitest. It has WebGPU in software. It ends with the worker. */
export const browser = await launchBrowser("--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader");

export async function newContext(options: BrowserContextOptions = {}): Promise<BrowserContext> {
  const context = await browser.newContext(options);
  // Software draws on a busy machine, so this limit only ends what hangs.
  context.setDefaultTimeout(120_000);
  return context;
}

/** A page in a context of its own. */
export async function newPage(options?: BrowserContextOptions): Promise<Page> {
  return (await newContext(options)).newPage();
}
