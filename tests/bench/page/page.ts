// The built page as a user sees it: the time to the first picture, the tasks that block its thread, and its memory.
import { servePage, launchBrowser } from "../../browser/site.js";
import type { Table } from "../report.js";
import { timeActions } from "./actions.js";
import { timeFollowing } from "./follow.js";
import { timeOpening } from "./open.js";
import { timeOrbit } from "./orbit.js";
import { soak } from "./soak.js";

export interface PageMeasured {
  /** The version of the browser, and its renderer. */
  chromium: string;
  page: Table[];
  soak: Table[];
}

export async function measurePage(wanted: { page: boolean; soak: boolean }): Promise<PageMeasured> {
  const files = new Map<string, Uint8Array>();
  // Served like a host with long caching: the second visit requests nothing.
  const site = await servePage(files, { "cache-control": "max-age=3600" });
  const browser = await launchBrowser();
  try {
    const { address } = site;
    const chromium = `${browser.version()} drawing with ${await rendererOf(browser)}`;
    const page = wanted.page
      ? [
          await timeOpening(browser, address),
          await timeFollowing(browser, address, files),
          ...(await timeOrbit(browser, address)),
          await timeActions(browser, address),
        ]
      : [];
    return { chromium, page, soak: wanted.soak ? [await soak(browser, address)] : [] };
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
