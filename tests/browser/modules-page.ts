import type { Page } from "playwright-core";
import { afterAll, beforeAll, expect } from "vitest";
import { newPage } from "./browser.js";
import { serveModules } from "./modules.js";

/** A page with these modules for all tests of a file. None may log an error. */
export function modulesPage(imports: Record<string, string>): { page: Page; said: string[] } {
  let close: () => void;
  const errors: string[] = [];
  // The page comes before the first test.
  const shared = { page: undefined as unknown as Page, said: [] as string[] };

  beforeAll(async () => {
    const site = await serveModules(imports);
    close = site.close;
    shared.page = await newPage({ viewport: { width: 400, height: 400 } });
    shared.page.on("pageerror", (error) => errors.push(String(error)));
    shared.page.on("console", (message) => {
      if (message.type() === "error") errors.push(message.text());
      if (message.text().startsWith("hidden-point-removal")) shared.said.push(message.text());
    });
    await shared.page.goto(site.address);
    await shared.page.waitForFunction(() => "modules" in globalThis);
  });

  afterAll(() => {
    close();
    expect(errors).toEqual([]);
  });
  return shared;
}
