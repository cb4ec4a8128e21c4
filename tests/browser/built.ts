import { join } from "node:path";
import { build } from "vite";

const ROOT = join(import.meta.dirname, "../..");

/** Bundles the page in a folder beside this file, as users do; returns its path in the repository. */
export async function builtPage(name: string): Promise<string> {
  const out = `target/tests/${name}`;
  await build({
    root: join(ROOT, "tests/browser", name),
    base: "./",
    logLevel: "error",
    build: { outDir: join(ROOT, out), emptyOutDir: true, target: "es2022", chunkSizeWarningLimit: 5000 },
    worker: { format: "es" },
  });
  return `${out}/index.html`;
}
