import { readdirSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import markdownIt from "markdown-it";
import type { Plugin } from "vite";

const root = new URL("../../", import.meta.url);
const README = "README.md";

/** Writes the README and the documents as pages beside the built page: docs/index.html, docs/API.html and so on. */
export function docs(): Plugin {
  return {
    name: "docs",
    apply: "build",
    generateBundle() {
      const names = readdirSync(new URL("docs/", root));
      const pages = names.filter((name) => name.endsWith(".md"));
      for (const name of [README, ...pages]) {
        const text = readFileSync(new URL(name === README ? name : `docs/${name}`, root), "utf8");
        this.emitFile({ type: "asset", fileName: `docs/${pageOf(name)}`, source: written(text, pages) });
      }
      for (const name of names.filter((other) => /\.(png|webp)$/.test(other))) {
        this.emitFile({
          type: "asset",
          fileName: `docs/${name}`,
          source: readFileSync(fileURLToPath(new URL(`docs/${name}`, root))),
        });
      }
    },
  };
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
