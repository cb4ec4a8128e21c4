import { existsSync, readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { createServer, type Plugin } from "vite";
import { writeCloud } from "hidden-point-removal/files";
import { make } from "../samples/living-room.ts";

/** Files by their names, each made when it is asked for. */
export type Files = Record<string, () => string | Uint8Array>;

const TYPES: Record<string, string> = {
  html: "text/html",
  js: "text/javascript",
  png: "image/png",
  txt: "text/plain",
  wasm: "application/wasm",
  webp: "image/webp",
};

/** Serves these files beside the pages, and writes them beside the built ones. */
export function filesBeside(files: () => Files): Pick<Plugin, "configureServer" | "generateBundle"> {
  return {
    configureServer(server) {
      server.middlewares.use((request, response, next) => {
        const name = new URL(request.url!, "http://localhost").pathname.slice(server.config.base.length);
        const type = TYPES[name.split(".").at(-1)!] ?? "application/octet-stream";
        const body = files()[name]?.();
        if (body === undefined) next();
        else response.writeHead(200, { "content-type": type }).end(body);
      });
    },
    generateBundle() {
      for (const [fileName, content] of Object.entries(files())) {
        this.emitFile({ type: "asset", fileName, source: content() });
      }
    },
  };
}

const EXAMPLES = join(import.meta.dirname, "../../examples");
const DIST = join(import.meta.dirname, "../../dist");

/** The examples that are pages, in the order of the gallery. */
const ORDER = ["hide", "dim", "measure", "labels", "lasso", "freeze", "tiles", "clouds", "splats", "colors", "deck", "react", "potree", "plain"]; // prettier-ignore
/** They import no module of node_modules, so they are served as they are. */
const AS_THEY_ARE = ["potree", "plain"];
const PICTURES = "pictures/";

const source = (name: string) => readFileSync(join(EXAMPLES, `${name}.html`), "utf8");

/** The pages that Vite bundles. */
export const bundledExamples = ["index", ...ORDER.filter((name) => !AS_THEY_ARE.includes(name))].map((name) =>
  join(EXAMPLES, `${name}.html`),
);

/** The examples as live pages: the gallery, each page's source, the cloud that they read, and the package for an import map. */
export function examples(): Plugin {
  return {
    name: "examples",
    transformIndexHtml: { order: "pre", handler: (html) => html.replace("<!-- gallery -->", ORDER.map(card).join("")) },
    ...filesBeside(files),
  };
}

/** Serves them under /examples/ of the page's own development server. */
export function underExamples(configFile: string): Plugin {
  return {
    name: "under /examples/",
    async configureServer(page) {
      const settings = { middlewareMode: true, hmr: false, ws: false } as const;
      const own = await createServer({ configFile, configLoader: "runner", base: "/examples/", server: settings });
      page.middlewares.use((request, response, next) => {
        if (request.url!.startsWith("/examples/")) own.middlewares(request, response, next);
        else next();
      });
      page.httpServer?.on("close", () => void own.close());
    },
  };
}

/** What is served beside the pages that Vite bundles. */
function files(): Files {
  const distributed = readdirSync(DIST).filter((name) => /^(?!inline|cli|command|hidden).*\.js$/.test(name));
  const given: [string, string][] = [
    ...[...distributed, "wasm/hpr_bg.wasm"].map((name): [string, string] => [`package/${name}`, join(DIST, name)]),
    ["hidden-point-removal.global.js", join(DIST, "hidden-point-removal.global.js")],
    ...pictures().map((name): [string, string] => [PICTURES + name, join(EXAMPLES, PICTURES, name)]),
  ];
  return Object.fromEntries([
    ...ORDER.map((name) => [`source/${name}.txt`, () => source(name)]),
    ...AS_THEY_ARE.map((name) => [`${name}.html`, () => source(name)]),
    ...given.map(([name, path]) => [name, () => readFileSync(path)]),
    ["room.ply", () => (room ??= roomFile())],
  ]) as Files;
}

const pictures = () => (existsSync(join(EXAMPLES, PICTURES)) ? readdirSync(join(EXAMPLES, PICTURES)) : []);

let room: Uint8Array | undefined;

/** Every third point of the page's room. */
function roomFile(): Uint8Array {
  const cloud = make();
  const indices = Uint32Array.from({ length: Math.floor(cloud.positions.length / 9) }, (_, i) => 3 * i);
  const { positions, colors } = cloud as { positions: Float32Array; colors: Uint8Array };
  return writeCloud({ positions, colors }, "ply", { indices });
}

function card(name: string): string {
  const [, title] = /<title>(.*)<\/title>/.exec(source(name))!;
  const [, description] = /<meta\s+name="description"\s+content="(.*)"\s*\/>/.exec(source(name))!;
  return `<article>
    <a href="${name}.html"><img src="./${PICTURES}${name}.webp" vite-ignore alt="" /></a>
    <h2><a href="${name}.html">${title}</a></h2>
    <p>${description}</p>
    <p><a href="source/${name}.txt">View source</a></p>
  </article>`;
}
