import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";
import { offline } from "./build/offline-plugin.ts";
import { samples } from "./build/samples-plugin.ts";

const here = (path: string) => fileURLToPath(new URL(path, import.meta.url));

export default defineConfig({
  root: here("."),
  // Relative addresses: the page can be served from any folder of any site.
  base: "./",
  build: { outDir: here("dist"), emptyOutDir: true, target: "es2022", chunkSizeWarningLimit: 900 },
  plugins: [samples(), offline()],
  // Of the decoder's builds the one for workers; the copc package would bring another.
  resolve: { alias: [{ find: /^laz-perf$/, replacement: "laz-perf/lib/worker/index.js" }] },
  worker: { format: "es" },
  // Its worker and its wasm are found beside its files.
  optimizeDeps: { exclude: ["hidden-point-removal"] },
});
