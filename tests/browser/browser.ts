import type { BrowserContext, BrowserContextOptions, Page } from "playwright-core";
import { launchBrowser } from "./site.js";

/** One browser for all test files of a worker of vitest. It has WebGPU in software. It ends with the worker. */
export const browser = await launchBrowser("--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader");

/** `HPR_LATE=1000`: workers hear of each message a second later, which shows the tests that need a quick answer. */
const LATE = Number(process.env["HPR_LATE"] ?? 0);

export async function newContext(options: BrowserContextOptions = {}): Promise<BrowserContext> {
  const context = await browser.newContext(options);
  // Software draws on a busy machine, so this limit only ends what hangs.
  context.setDefaultTimeout(120_000);
  if (LATE > 0) await context.addInitScript(delayMessages, LATE);
  return context;
}

function delayMessages(milliseconds: number): void {
  globalThis.Worker = class extends Worker {
    override postMessage(message: unknown, options?: Transferable[] | StructuredSerializeOptions): void {
      setTimeout(() => super.postMessage(message, options as StructuredSerializeOptions), milliseconds);
    }
  };
}

/** A page in a context of its own. */
export async function newPage(options?: BrowserContextOptions): Promise<Page> {
  return (await newContext(options)).newPage();
}
