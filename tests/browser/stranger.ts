// A foreign page with elements from another origin, under the strictest security policy that they allow.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { Page } from "playwright-core";
import type { HiddenPointCloudElement } from "../../www/element/api.js";
import { root } from "../root.js";
import { openPage, served } from "./support.js";

/** The parts of an element's events that can be sent to the test. */
export interface Heard {
  id: string;
  type: string;
  detail: {
    total?: number;
    count?: number;
    viewpoint?: [number, number, number];
    radius?: number;
    index?: number;
    code?: string;
    attribute?: string;
    message?: string;
  };
}

const SCRIPT = `
  const pictures = [];
  const own = HTMLCanvasElement.prototype.getContext;
  HTMLCanvasElement.prototype.getContext = function (...given) {
    const context = own.apply(this, given);
    if (context instanceof WebGL2RenderingContext && !pictures.includes(context)) pictures.push(context);
    return context;
  };
  globalThis.livePictures = () => pictures.filter((context) => !context.isContextLost()).length;
  globalThis.heard = [];
  globalThis.forbidden = [];
  document.addEventListener("securitypolicyviolation", (event) => forbidden.push(event.violatedDirective + " " + event.blockedURI));
  // Events that do not bubble can still be captured.
  for (const type of ["load", "change", "progress", "error", "pick"]) {
    document.addEventListener(type, ({ target, detail }) => {
      if (target.localName !== "hidden-point-cloud") return;
      const { error, ...rest } = detail;
      heard.push({ id: target.id, type, detail: error ? { code: error.code, attribute: error.attribute, message: error.message } : rest });
    }, true);
  }
`;

/** The policy of docs/EMBED.md, and the additions that this page needs. */
export function policyFor(origin: string): string {
  const [, given] = /^```\n(default-src .*)\n```$/m.exec(readFileSync(join(root, "docs/EMBED.md"), "utf8"))!;
  return `${given!.replaceAll("https://example.org", origin).replace("script-src", "script-src 'self'")}; style-src 'unsafe-inline'; img-src data:`;
}

/** Opens a page with this body. The element comes from `address`. */
export async function openStranger(address: string, body: string, more = ""): Promise<Page> {
  const head = `<meta charset="utf-8"><meta http-equiv="Content-Security-Policy" content="${policyFor(new URL(address).origin)}"><link rel="icon" href="data:,">`;
  const scripts = `<script src="stranger.js"></script><script type="module" src="${address}hidden-point-cloud.js"></script>`;
  served.set("stranger.js", Buffer.from(SCRIPT));
  served.set(
    "stranger.html",
    Buffer.from(`<!doctype html><html lang="en"><head>${head}${scripts}</head><body>${body}${more}</body></html>`),
  );
  return openPage("stranger.html");
}

/** Waits until the element's cloud is ready or has failed. */
export async function settledState(page: Page, id: string): Promise<string> {
  return element(page, id, async (cloud) => {
    await cloud.ready.catch(() => undefined);
    return cloud.state;
  });
}

/** Runs a function on an element in the page. */
export function element<T, Given = undefined>(
  page: Page,
  id: string,
  ask: (cloud: HiddenPointCloudElement, given: Given) => T | Promise<T>,
  given?: Given,
): Promise<T> {
  return page.locator(`#${id}`).evaluate<T, Given | undefined, HiddenPointCloudElement>(ask as never, given);
}

export function heardBy(page: Page, id: string, type: string): Promise<Heard["detail"][]> {
  return page.evaluate(
    ([who, what]) =>
      (globalThis as unknown as { heard: Heard[] }).heard
        .filter((told) => told.id === who && told.type === what)
        .map(({ detail }) => detail),
    [id, type] as const,
  );
}

/** Runs `act` and waits for the next event of this kind. */
export async function hears(
  page: Page,
  id: string,
  type: string,
  act: () => Promise<unknown>,
): Promise<Heard["detail"]> {
  const before = (await heardBy(page, id, type)).length;
  await act();
  await page.waitForFunction(
    ([who, what, count]) =>
      (globalThis as unknown as { heard: Heard[] }).heard.filter((told) => told.id === who && told.type === what)
        .length > count,
    [id, type, before] as const,
  );
  return (await heardBy(page, id, type))[before]!;
}
