import type { Plugin } from "vite";

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
