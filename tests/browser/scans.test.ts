import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, test } from "vitest";
import { openReady, reached } from "./support.js";

test("an E57 file is opened, and a damaged one is refused", async () => {
  const page = await openReady("?sample=bunny");
  const buffer = readFileSync(join(import.meta.dirname, "fixtures/two-scans.e57"));
  const open = (name: string, content: Buffer) =>
    page.locator("#file").setInputFiles({ name, mimeType: "", buffer: content });
  await open("broken.e57", buffer.subarray(0, 5000));
  expect((await reached(page, "error")).sentence).toMatch(/^broken\.e57 cannot be read: .*truncated.*near byte 0/);
  await open("scans.e57", buffer);
  await page.waitForFunction(() => document.querySelector("#status")?.getAttribute("data-total") === "44");
});
