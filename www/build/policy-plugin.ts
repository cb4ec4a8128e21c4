import { createHash } from "node:crypto";
import type { Plugin } from "vite";

/**
 * Writes the page's Content-Security-Policy into its head: it holds on every static host, and in the copy that the
 * service worker keeps. Only when the page is built, since Vite's own server needs more.
 */
export function policy(): Plugin {
  return {
    name: "policy",
    apply: "build",
    transformIndexHtml: {
      order: "post",
      handler(html) {
        const meta = `<meta http-equiv="Content-Security-Policy" content="${policyOf(html)}" />`;
        // It counts for what comes after it, and the character set must be said within the first 1024 bytes.
        const page = html.replace(CHARSET, (charset) => `${charset}\n    ${meta}`);
        if (page === html) throw new Error("The page does not say its character set.");
        return page;
      },
    },
  };
}

const CHARSET = /<meta charset="[^"]+" ?\/?>/;

/** What a page of this text may do. */
function policyOf(html: string): string {
  const rules: Record<string, string[]> = {
    "default-src": ["'none'"],
    // The core is WebAssembly.
    "script-src": ["'self'", "'wasm-unsafe-eval'", ...hashes(html, "script")],
    "style-src": ["'self'", ...hashes(html, "style")],
    // Marks are drawn into an exported picture through data:, textures of a file come through blob:.
    "img-src": ["'self'", "data:", "blob:"],
    // Files of `?src=` lie anywhere; a glTF file may hold its own buffers.
    "connect-src": ["'self'", "http:", "https:", "data:", "blob:"],
    "worker-src": ["'self'"],
    "manifest-src": ["'self'"],
    "base-uri": ["'none'"],
    "form-action": ["'none'"],
  };
  return Object.entries(rules)
    .map(([rule, sources]) => `${rule} ${sources.join(" ")}`)
    .join("; ");
}

/** Of the scripts or styles that the page itself holds. */
function hashes(html: string, tag: "script" | "style"): string[] {
  // Attributes mean a script of its own file, or none at all.
  const inline = new RegExp(`<${tag}>(.*?)</${tag}>`, "gs");
  return [...html.matchAll(inline)].map(
    ([, text]) => `'sha256-${createHash("sha256").update(text!).digest("base64")}'`,
  );
}
