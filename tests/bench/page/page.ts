// The built page as a user sees it: the time to the first picture, the answers while it moves, and what blocks its thread.
import { servePage, launchBrowser } from "../../browser/site.js";
import type { Table } from "../report.js";
import { timeFollowing } from "./follow.js";
import { timeOpening } from "./open.js";
import { timeOrbit } from "./orbit.js";

export interface PageMeasured {
  /** The version of the browser, and its renderer. */
  chromium: string;
  tables: Table[];
}

export async function measurePage(): Promise<PageMeasured> {
  const files = new Map<string, Uint8Array>();
  // Served like a host with long caching: the second visit requests nothing.
  const site = await servePage(files, { "cache-control": "max-age=3600" });
  const browser = await launchBrowser();
  try {
    const { address } = site;
    const chromium = `${browser.version()} drawing with ${await rendererOf(browser)}`;
    const tables = [
      await timeOpening(browser, address),
      await timeFollowing(browser, address, files),
      ...(await timeOrbit(browser, address)),
    ];
    return { chromium, tables };
  } finally {
    await browser.close();
    site.close();
  }
}

async function rendererOf(browser: Awaited<ReturnType<typeof launchBrowser>>): Promise<string> {
  const page = await browser.newPage();
  const name = await page.evaluate(() => {
    const gl = document.createElement("canvas").getContext("webgl2");
    const info = gl?.getExtension("WEBGL_debug_renderer_info");
    return info ? String(gl!.getParameter(info.UNMASKED_RENDERER_WEBGL)) : "an unnamed renderer";
  });
  await page.close();
  return name;
}
