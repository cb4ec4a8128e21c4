import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import type { AddressInfo } from "node:net";
import { extname, join, normalize } from "node:path";

const ROOT = join(import.meta.dirname, "../..");
const TYPES: Record<string, string> = { ".js": "text/javascript", ".wasm": "application/wasm", ".html": "text/html" };

/**
 * A page with modules from the repository's files, found by an import map. Nothing is bundled.
 * After loading, `modules` holds them by their names.
 */
export async function serveModules(imports: Record<string, string>): Promise<{ address: string; close: () => void }> {
  // A name with a slash at its end stands for a folder.
  const names = Object.keys(imports).filter((name) => !name.endsWith("/"));
  const load = `Promise.all(${JSON.stringify(names)}.map(async (name) => [name, await import(name)]))`;
  const page = `<!doctype html><link rel="icon" href="data:,"><body>
    <script type="importmap">${JSON.stringify({ imports })}</script>
    <script type="module">globalThis.modules = Object.fromEntries(await ${load});</script>`;
  const server = createServer((request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url!, "http://localhost").pathname));
    try {
      const body = path === "/" ? page : readFileSync(join(ROOT, path));
      response.writeHead(200, { "content-type": TYPES[extname(path)] ?? "text/html" }).end(body);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise<void>((resolve) => server.listen(0, "127.0.0.1", resolve));
  return {
    address: `http://127.0.0.1:${(server.address() as AddressInfo).port}/`,
    close: () => {
      server.close();
    },
  };
}
