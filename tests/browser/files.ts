import type { Page } from "playwright-core";
import { expect } from "vitest";
import { answered, answerInNode, refiltered, status } from "./support.js";

/** Drops what `make` puts into the transfer on to the cloud. */
export async function dropped(page: Page, make: (data: DataTransfer) => void): Promise<void> {
  const transfer = await page.evaluateHandle(
    `(() => { const data = new DataTransfer(); (${String(make)})(data); return data; })()`,
  );
  await page.dispatchEvent("#view", "drop", { dataTransfer: transfer });
}

/** Opens a file as the button does. */
export async function choose(page: Page, name: string, content: Uint8Array): Promise<void> {
  await page.locator("#file").setInputFiles({ name, mimeType: "", buffer: Buffer.from(content) });
}

/** Drops a file on to the cloud. */
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

/**
 * Moves the camera after every eighth refused file and after the last one: the cloud is still there and answers. A refusal
 * that breaks something breaks it for good, so this need not be done after each file.
 */
export async function stillAnswers(page: Page, number: number, of: number): Promise<void> {
  if (number % 8 !== 7 && number !== of - 1) return;
  const before = await status(page);
  await page.locator("#view").press("ArrowLeft");
  expect(await refiltered(page, before)).toMatchObject({ state: "ready", total: 1839 });
}

/**
 * Opens files by button and drop in turn. Each opens without a message, and its answer equals the package's. The page must
 * not take looks (`looks=0`): they would be a second answer, which may come while the next file is opened.
 */
export async function openInTurn(
  page: Page,
  files: readonly [name: string, content: Uint8Array, positions: Float32Array | Float64Array][],
): Promise<void> {
  for (const [i, [name, content, positions]] of files.entries()) {
    const before = await status(page);
    await (i % 2 === 0 ? choose : drop)(page, name, content);
    const now = await answered(page, before);
    expect(now, name).toMatchObject({
      state: "ready",
      total: positions.length / 3,
      ...(await answerInNode(positions, now)),
    });
    expect(await page.locator("#panel .credit").textContent()).toContain(name);
    expect(await page.locator("#message").isVisible(), name).toBe(false);
  }
}
