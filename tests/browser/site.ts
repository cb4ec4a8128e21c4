import { existsSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import type { AddressInfo } from "node:net";
import { extname, join, normalize } from "node:path";
import { type Browser, chromium, type Page } from "playwright-core";
import { root } from "../root.js";

const DIST = join(root, "www", "dist");
/** The page is served from a folder, like a project's site, so that an absolute address in it would fail. */
const FOLDER = "/some/folder/";
/** Extra files in this folder can be requested in ranges. */
const RANGED = "ranged/";
const TYPES: Record<string, string> = {
  ".html": "text/html",
  ".js": "text/javascript",
  ".css": "text/css",
  ".svg": "image/svg+xml",
  ".wasm": "application/wasm",
  ".avif": "image/avif",
};

export interface Site {
  /** The page's address, with a slash at its end. */
  address: string;
  /** Every requested file, in order. */
  asked: string[];
  close(): void;
  /** Stops the server and closes all its connections. */
  vanish(): void;
}

/** Serves the built page, and `extra` files beside it or instead of its own files. `headers` may allow other sites to read them. */
export async function servePage(
  extra: ReadonlyMap<string, Uint8Array> = new Map(),
  headers: Record<string, string> = {},
): Promise<Site> {
  const asked: string[] = [];
  const server = createServer((request, response) => {
    const path = decodeURIComponent(new URL(request.url!, "http://localhost").pathname);
    const name = path.startsWith(FOLDER) ? path.slice(FOLDER.length) || "index.html" : "";
    asked.push(name);
    const file = join(DIST, normalize(name));
    const own = name !== "" && file.startsWith(DIST) && existsSync(file);
    const body = extra.get(name) ?? (own ? readFileSync(file) : null);
    const range = /^bytes=(\d+)-(\d+)$/.exec(request.headers.range ?? "");
    if (body && range && name.startsWith(RANGED)) {
      response.writeHead(206, { "content-type": "application/octet-stream" });
      response.end(body.subarray(Number(range[1]), Number(range[2]) + 1));
      return;
    }
    response.writeHead(body ? 200 : 404, {
      ...headers,
      "content-type": TYPES[extname(file)] ?? "application/octet-stream",
    });
    response.end(body);
  });
  await new Promise<void>((resolve) => server.listen(0, "127.0.0.1", resolve));
  return {
    address: `http://127.0.0.1:${(server.address() as AddressInfo).port}${FOLDER}`,
    asked,
    close: () => {
      server.close();
    },
    vanish: () => {
      server.close();
      server.closeAllConnections();
    },
  };
}

export function launchBrowser(...args: string[]): Promise<Browser> {
  return chromium.launch({ executablePath: process.env["HPR_CHROMIUM"] ?? "/usr/bin/chromium", args });
}

/** Leaves the picture alone on pages that are opened later. */
export async function hideControls(page: Page): Promise<void> {
  await page.addInitScript(() => {
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(`
      #verbs, #name, #drawer, #signs, #marks, #tools, #panel, #divider, #compare-note { display: none !important }
      body { grid-template: minmax(0, 1fr) / minmax(0, 1fr) !important }`);
    document.adoptedStyleSheets.push(sheet);
  });
}

/** Adds a style in a way that the page's security policy allows. */
export async function addStyle(page: Page, css: string): Promise<void> {
  await page.evaluate((text) => {
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(text);
    document.adoptedStyleSheets.push(sheet);
  }, css);
}
