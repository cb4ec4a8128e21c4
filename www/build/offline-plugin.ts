import { createHash } from "node:crypto";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { type Plugin, transformWithOxc } from "vite";

const SOURCE = fileURLToPath(new URL("../offline/service-worker.ts", import.meta.url));
const PAGE = "index.html";
/** The folder of files whose names change with their content. */
const HASHED = "assets/";
const SAMPLES = "samples/";

/** Writes service-worker.js beside the page: offline/service-worker.ts with the files of this build. */
export function offline(): Plugin {
  let publicDir = "";
  return {
    name: "offline",
    apply: "build",
    configResolved(config) {
      publicDir = config.publicDir;
    },
    generateBundle: {
      // It runs late, when the page itself is among the files.
      order: "post",
      async handler(_, bundle) {
        const built = Object.keys(bundle);
        const copied = readdirSync(publicDir, { recursive: true, withFileTypes: true })
          .filter((entry) => entry.isFile())
          .map((entry) =>
            join(entry.parentPath, entry.name)
              .slice(publicDir.length + 1)
              .replaceAll("\\", "/"),
          );
        const files = [...built, ...copied].sort();
        const source = readFileSync(SOURCE, "utf8");
        const page = bundle[PAGE];
        const entry = Object.values(bundle).find((file) => file.type === "chunk" && file.isEntry);
        if (page?.type !== "asset" || !entry) throw new Error("The page has no text or no script.");
        const fixed = copied.filter((name) => !name.startsWith(SAMPLES));

        const digest = createHash("sha256").update(source).update(page.source).update(files.join());
        for (const name of fixed) digest.update(readFileSync(join(publicDir, name)));
        const build = {
          version: digest.digest("hex").slice(0, 16),
          entry: entry.fileName,
          assets: built.filter((name) => name.startsWith(HASHED)),
          fixed,
          samples: copied.filter((name) => name.startsWith(SAMPLES)),
        };
        const { code } = await transformWithOxc(source, SOURCE, { target: "es2022" });
        this.emitFile({
          type: "asset",
          fileName: "service-worker.js",
          source: `const BUILD = ${JSON.stringify(build)};\n${code}`,
        });
      },
    },
  };
}
