import { readdirSync, readFileSync } from "node:fs";
import markdownIt from "markdown-it";
import type { Plugin } from "vite";
import { type Files, filesBeside } from "./examples-plugin.ts";

const root = new URL("../../", import.meta.url);
const README = "README.md";

/** The README and the documents as pages beside the page, built or served: docs/index.html, docs/API.html and so on. */
export function docs(): Plugin {
  return { name: "docs", ...filesBeside(files) };
}

function files(): Files {
  const names = readdirSync(new URL("docs/", root));
  const pages = names.filter((name) => name.endsWith(".md"));
  const texts = [README, ...pages].map((name) => {
    const place = new URL(name === README ? name : `docs/${name}`, root);
    return [`docs/${pageOf(name)}`, () => written(readFileSync(place, "utf8"), pages)] as const;
  });
  const pictures = names.filter((name) => /\.(png|webp)$/.test(name));
  const shown = pictures.map((name) => [`docs/${name}`, () => readFileSync(new URL(`docs/${name}`, root))] as const);
  return Object.fromEntries<() => string | Uint8Array>([...texts, ...shown]);
}

const pageOf = (name: string) => (name === README ? "index.html" : name.replace(/md$/, "html"));

function written(text: string, pages: readonly string[]): string {
  const body = markdownIt({ html: true })
    .render(text)
    // A heading can be linked to by its words.
    .replace(
      /<(h[1-6])>(.*?)<\/\1>/g,
      (_, tag: string, words: string) => `<${tag} id="${anchorOf(words)}">${words}</${tag}>`,
    )
    .replace(
      / (src|href)="(?!https?:|#)(?:\.\.\/)?(?:docs\/)?([^"#]*)(#[^"]*)?"/g,
      (_, name: string, file: string, at = "") => {
        if (name === "src") return ` src="${file}"`;
        // Other files of the project are not beside these pages.
        return file === README || pages.includes(file) ? ` href="${pageOf(file)}${at}"` : "";
      },
    );
  const title = /^# (.*)$/m.exec(text)?.[1] ?? "";
  return `<!doctype html>
<html lang="en">
  <head>
    <meta charset="utf-8" />
    <meta name="viewport" content="width=device-width, initial-scale=1" />
    <meta name="color-scheme" content="dark light" />
    <title>${title}</title>
    <style>
      body { max-width: 52rem; margin: 0 auto; padding: 1rem; font: 1rem/1.5 system-ui, sans-serif; }
      table, pre { display: block; overflow-x: auto; }
      td, th { padding: 2px 8px; text-align: left; vertical-align: top; }
      img { max-width: 100%; }
    </style>
  </head>
  <body>
    <nav><a href="../index.html">The page</a> · <a href="index.html">Readme</a></nav>
${body}  </body>
</html>
`;
}

/** As on GitHub. */
function anchorOf(words: string): string {
  return words
    .replace(/<[^>]+>/g, "")
    .toLowerCase()
    .replace(/[^\p{L}\p{N}\s_-]/gu, "")
    .trim()
    .replace(/\s/g, "-");
}
