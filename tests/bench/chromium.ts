// The package in Chromium, on a page that does nothing else.
import { createReadStream, existsSync } from "node:fs";
import { createServer, type Server } from "node:http";
import type { AddressInfo } from "node:net";
import { basename, extname, join, normalize } from "node:path";

import { type Browser, chromium } from "playwright-core";

import type { Engine } from "./engines.js";
import type { Outcome, Task } from "./measure.js";
import { root, scratch, writeCloud } from "./paths.js";

/** A few clouds are enough to see how the browser compares with Node. */
const CLOUDS = ["dragon", "dragon_res3", "bunny-36k", "room", "bumpy-300k"];

const FOLDERS: Record<string, string> = {
  dist: join(root, "dist"),
  bench: import.meta.dirname,
  clouds: scratch("."),
};
const PAGE = `<script type="importmap">{"imports": {"hidden-point-removal": "/dist/index.js"}}</script>
<script type="module">import * as bench from "/bench/measure.js"; globalThis.bench = bench;</script>`;
const TYPES: Record<string, string> = { ".js": "text/javascript", ".wasm": "application/wasm" };
/** A page that is alone in its process gets a clock of 5 µs instead of 100. */
const HEADERS = { "cross-origin-opener-policy": "same-origin", "cross-origin-embedder-policy": "require-corp" };

export interface BrowserEngine extends Engine {
  version: string;
  close(): Promise<void>;
}

/** Undefined, with a message, if there is no Chromium (scripts/bench.ts looks for it). */
export async function openChromium(): Promise<BrowserEngine | undefined> {
  const executablePath = process.env["HPR_CHROMIUM"];
  if (executablePath === undefined) {
    console.error("Left out: Chromium, which is not installed here (name one in HPR_CHROMIUM).");
    return undefined;
  }
  const server = await serve();
  const browser = await chromium.launch({ executablePath });
  return {
    name: "Chromium",
    version: browser.version(),
    takes: ({ name }) => CLOUDS.includes(name),
    measure(cloud, tasks) {
      const [file, precision] = writeCloud(cloud);
      return measureInPage(browser, server, { cloud: `/clouds/${basename(file)}`, precision, tasks });
    },
    async close() {
      await browser.close();
      server.close();
    },
  };
}

async function serve(): Promise<Server> {
  const server = createServer((request, response) => {
    const [, folder, ...path] = normalize(new URL(request.url!, "http://localhost").pathname).split("/");
    const file = join(FOLDERS[folder!] ?? "", ...path);
    if (folder === "") {
      response.writeHead(200, { ...HEADERS, "content-type": "text/html" }).end(PAGE);
    } else if (FOLDERS[folder!] === undefined || !existsSync(file)) {
      response.writeHead(404).end();
    } else {
      response.writeHead(200, { ...HEADERS, "content-type": TYPES[extname(file)] ?? "application/octet-stream" });
      createReadStream(file).pipe(response);
    }
  });
  await new Promise<void>((resolve) => server.listen(0, "127.0.0.1", resolve));
  return server;
}

interface PageWork {
  cloud: string;
  precision: string;
  tasks: Task[];
}

async function measureInPage(browser: Browser, server: Server, work: PageWork): Promise<Outcome[]> {
  const page = await browser.newPage();
  try {
    await page.goto(`http://127.0.0.1:${(server.address() as AddressInfo).port}/`);
    return await page.evaluate(async ({ cloud, precision, tasks }) => {
      const { measure } = (globalThis as unknown as { bench: typeof import("./measure.js") }).bench;
      const bytes = await (await fetch(cloud)).arrayBuffer();
      const positions = precision === "f32" ? new Float32Array(bytes) : new Float64Array(bytes);
      return measure(new URL("/dist/wasm/hpr_bg.wasm", location.href), positions, tasks);
    }, work);
  } finally {
    await page.close();
  }
}
