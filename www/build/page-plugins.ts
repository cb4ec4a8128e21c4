import { type HtmlTagDescriptor, type Plugin, type Rolldown, runnerImport, type UserConfig } from "vite";
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import ts from "typescript";

/** Options of Vite that the page and the element share. */
export const COMMON = {
  // Relative addresses: both can be served from any folder of any site.
  base: "./",
  worker: { format: "es" },
  // The library finds its worker and its wasm beside its own files.
  optimizeDeps: { exclude: ["hidden-point-removal"] },
} satisfies UserConfig;

/** Writes into index.html how right the first picture is; each build asks again. */
export function html(): Plugin {
  return {
    name: "html",
    transformIndexHtml: {
      order: "pre",
      handler: async (page) => {
        const file = fileURLToPath(new URL("verdict.ts", import.meta.url));
        const { module } = await runnerImport<typeof import("./verdict.ts")>(file);
        return page.replace("<span data-verdict>", (tag) => tag + module.verdict);
      },
    },
  };
}

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

/**
 * Writes the page's Content-Security-Policy into its head. So the policy holds on every static host, and in the copy
 * that the service worker keeps. It is written only when the page is built, because Vite's own server needs more
 * rights.
 */
export function policy(): Plugin {
  return {
    name: "policy",
    apply: "build",
    transformIndexHtml: {
      order: "post",
      handler(html) {
        const meta = `<meta http-equiv="Content-Security-Policy" content="${policyOf(html)}" />`;
        // The policy holds only for the text after it. But the character set must be in the first 1024 bytes.
        const page = html.replace(CHARSET, (charset) => `${charset}\n    ${meta}`);
        if (page === html) throw new Error("The page does not say its character set.");
        return page;
      },
    },
  };
}

const CHARSET = /<meta charset="[^"]+" ?\/?>/;

/** The policy for a page with this text. */
function policyOf(html: string): string {
  const rules: Record<string, string[]> = {
    "default-src": ["'none'"],
    // The core is WebAssembly.
    "script-src": ["'self'", "'wasm-unsafe-eval'", ...hashes(html, "script")],
    "style-src": ["'self'", ...hashes(html, "style")],
    // An exported picture gets its marks through data:. The textures of a file come through blob:.
    "img-src": ["'self'", "data:", "blob:"],
    // A file of `?src=` may be on any server. A glTF file may contain its own buffers.
    "connect-src": ["'self'", "http:", "https:", "data:", "blob:"],
    "worker-src": ["'self'"],
    "base-uri": ["'none'"],
    "form-action": ["'none'"],
  };
  return Object.entries(rules)
    .map(([rule, sources]) => `${rule} ${sources.join(" ")}`)
    .join("; ");
}

/** The hashes of the scripts or styles that are in the page itself. */
function hashes(html: string, tag: "script" | "style"): string[] {
  // A tag with attributes is a script in its own file, or not a script at all.
  const inline = new RegExp(`<${tag}>(.*?)</${tag}>`, "gs");
  return [...html.matchAll(inline)].map(
    ([, text]) => `'sha256-${createHash("sha256").update(text!).digest("base64")}'`,
  );
}

/** Writes the types of a source file beside the built files. */
export function declarations(source: string, fileName: string): Plugin {
  return {
    name: "declarations",
    generateBundle() {
      const { outputText, diagnostics = [] } = ts.transpileDeclaration(readFileSync(source, "utf8"), {
        fileName: source,
      });
      if (diagnostics.length > 0) this.error(ts.flattenDiagnosticMessageText(diagnostics[0]!.messageText, "\n"));
      this.emitFile({ type: "asset", fileName, source: outputText });
    },
  };
}
