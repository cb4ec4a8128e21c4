import { join } from "node:path";
import { build } from "vite";

const ROOT = join(import.meta.dirname, "../..");

/** Bundles the page in a folder beside this file, like users do. Returns its path in the repository. */
export function builtPage(name: string): Promise<string> {
  return builtFrom(join(ROOT, "tests/browser", name), name);
}

/** Bundles a page in any folder of the repository. */
export async function builtFrom(source: string, name: string): Promise<string> {
  const out = `target/tests/${name}`;
  await build({
    root: source,
    configFile: false,
    base: "./",
    logLevel: "error",
    build: { outDir: join(ROOT, out), emptyOutDir: true, target: "es2022", chunkSizeWarningLimit: 5000 },
    worker: { format: "es" },
  });
  return `${out}/index.html`;
}
