import { createHash } from "node:crypto";
import type { Plugin } from "vite";

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
