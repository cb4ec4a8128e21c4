import type { HtmlTagDescriptor, Plugin, Rolldown } from "vite";

/** The files that every first picture needs. The page's own script asks for them late. */
const SCRIPT = "assets/session-";
const WASM = "assets/hpr_bg-";

/** Lets the browser fetch these files beside the page's own script. It cannot do so for workers: they are asked for early. */
export function ahead(): Plugin {
  return {
    name: "ahead",
    apply: "build",
    transformIndexHtml: {
      order: "post",
      handler: (html, { bundle = {} }) => {
        const scripts = withImports(named(bundle, SCRIPT), bundle).filter((file) => !html.includes(file));
        return [
          ...scripts.map((file) => link(file, { rel: "modulepreload" })),
          link(named(bundle, WASM), { rel: "preload", as: "fetch", type: "application/wasm" }),
        ];
      },
    },
  };
}

function named(bundle: Rolldown.OutputBundle, begins: string): string {
  const file = Object.keys(bundle).find((name) => name.startsWith(begins));
  if (file === undefined) throw new Error(`The page has no file ${begins}….`);
  return file;
}

/** A script with all that it imports. */
function withImports(script: string, bundle: Rolldown.OutputBundle, found = new Set<string>()): string[] {
  const chunk = bundle[script];
  if (chunk?.type !== "chunk" || found.has(script)) return [...found];
  found.add(script);
  for (const file of chunk.imports) withImports(file, bundle, found);
  return [...found];
}

function link(file: string, attrs: NonNullable<HtmlTagDescriptor["attrs"]>): HtmlTagDescriptor {
  return { tag: "link", attrs: { ...attrs, crossorigin: true, href: `./${file}` }, injectTo: "head" };
}
