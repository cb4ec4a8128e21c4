import type { Consumer, Visit } from "./consumer";
import { consumers } from "./install";
import { html, serve, STRICT } from "./serve";

const DIST = "node_modules/hidden-point-removal/dist";

/** Pages without a bundler: they import the package's modules as they are. */
export const pages = (visit: Visit, browser: string): Consumer[] => {
  const page = (name: string, script: string, options: Parameters<typeof serve>[1] = {}): Consumer => ({
    name,
    version: browser,
    run: async () => {
      await using site = await serve(consumers, { ...options, pages: { "index.html": html(script) } });
      return await visit(`${site.address}index.html`);
    },
  });
  return [
    page("<script type=module>", importMap("/") + module("app/main.js")),
    page("<script type=module>, strict security policy", module("pages/relative.js"), { headers: STRICT }),
    page("./inline, no .wasm file served", module("pages/inline.js"), { refused: /\.wasm$/ }),
    page("./inline, strict security policy", module("pages/inline.js"), { headers: STRICT, refused: /\.wasm$/ }),
    { ...page("<script type=module>, ./lite", importMap("/") + module("lite/main.js")), further: true },
    page("a module worker of the page's own", module("pages/starts-worker.js")),
    {
      name: "a CDN: the package on another origin",
      version: browser,
      run: async () => {
        await using cdn = await serve(consumers, { headers: { "access-control-allow-origin": "*" } });
        const index = html(importMap(cdn.address) + module("app/main.js"));
        await using site = await serve(consumers, { refused: /node_modules/, pages: { "index.html": index } });
        return await visit(`${site.address}index.html`);
      },
    },
  ];
};

export const module = (file: string) => `<script type="module" src="projects/${file}"></script>`;

/** Resolves the package's names without a bundler. */
export function importMap(origin: string): string {
  const imports = {
    "hidden-point-removal": `${origin}${DIST}/index.js`,
    "hidden-point-removal/worker": `${origin}${DIST}/worker.js`,
    "hidden-point-removal/lite": `${origin}${DIST}/lite.js`,
  };
  return `<script type="importmap">${JSON.stringify({ imports })}</script>`;
}
