import type { Browser, Page } from "playwright-core";

import type { Answered } from "./consumer";

/** Opens a page and waits for the text of its `<output>`. */
export async function visitWith(
  browser: Browser,
  address: string,
  prepare?: (page: Page) => Promise<unknown>,
): Promise<Answered> {
  const page = await browser.newPage();
  // Machines differ in speed: this only ends what hangs.
  page.setDefaultTimeout(120_000);
  const complaints: string[] = [];
  page.on("console", (message) => complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(String(error)));
  try {
    await prepare?.(page);
    await page.goto(address);
    const output = page.locator("output[data-done]");
    await output.waitFor({ state: "attached" }).catch(() => {
      throw new Error(`no answer: ${complaints.join("; ")}`);
    });
    return JSON.parse((await output.textContent())!) as Answered;
  } finally {
    await page.close();
  }
}
