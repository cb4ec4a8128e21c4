import type { UserConfig } from "vite";

/** What the page and the element are built with alike. */
export const COMMON = {
  // Relative addresses: both can be served from any folder of any site.
  base: "./",
  // Of the decoder's builds the one for workers; the copc package would bring another.
  resolve: { alias: [{ find: /^laz-perf$/, replacement: "laz-perf/lib/worker/index.js" }] },
  worker: { format: "es" },
  // Its worker and its wasm are found beside its files.
  optimizeDeps: { exclude: ["hidden-point-removal"] },
} satisfies UserConfig;
