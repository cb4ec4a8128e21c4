import type { Page } from "playwright-core";
import { expect } from "vitest";

/** As by the button. */
export async function choose(page: Page, name: string, content: Uint8Array): Promise<void> {
  await page.locator("#file").setInputFiles({ name, mimeType: "", buffer: Buffer.from(content) });
}

/** Dropped on to the cloud. */
export async function drop(page: Page, name: string, content: Uint8Array): Promise<void> {
  const transfer = await page.evaluateHandle(
    ([fileName, bytes]) => {
      const data = new DataTransfer();
      data.items.add(new File([Uint8Array.from(atob(bytes), (char) => char.charCodeAt(0))], fileName));
      return data;
    },
    [name, Buffer.from(content).toString("base64")] as const,
  );
  await page.dispatchEvent("#view", "dragover", { dataTransfer: transfer });
  expect(await page.locator("#drop").isVisible()).toBe(true);
  await page.dispatchEvent("#view", "drop", { dataTransfer: transfer });
  expect(await page.locator("#drop").isVisible()).toBe(false);
}
