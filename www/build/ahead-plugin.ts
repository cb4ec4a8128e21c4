import type { HtmlTagDescriptor, Plugin } from "vite";

/** The files that every first picture needs, by the beginnings of their names. The page's own script asks for them late. */
const AHEAD: { begins: string; attrs: NonNullable<HtmlTagDescriptor["attrs"]> }[] = [
  { begins: "assets/session-", attrs: { rel: "modulepreload" } },
  { begins: "assets/hpr_bg-", attrs: { rel: "preload", as: "fetch", type: "application/wasm" } },
];

/** Lets the browser fetch these files beside the page's own script. It cannot do so for workers: they are asked for early. */
export function ahead(): Plugin {
  return {
    name: "ahead",
    apply: "build",
    transformIndexHtml: {
      order: "post",
      handler: (_, { bundle = {} }) =>
        AHEAD.map(({ begins, attrs }) => {
          const file = Object.keys(bundle).find((name) => name.startsWith(begins));
          if (file === undefined) throw new Error(`The page has no file ${begins}….`);
          return { tag: "link", attrs: { ...attrs, crossorigin: true, href: `./${file}` }, injectTo: "head" };
        }),
    },
  };
}
