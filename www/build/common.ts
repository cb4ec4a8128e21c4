import type { UserConfig } from "vite";

/** Options of Vite that the page and the element share. */
export const COMMON = {
  // Relative addresses: both can be served from any folder of any site.
  base: "./",
  // The decoder's build for workers; the copc package would bring another one.
  resolve: { alias: [{ find: /^laz-perf$/, replacement: "laz-perf/lib/worker/index.js" }] },
  worker: { format: "es" },
  // Its worker and its wasm are found beside its files.
  optimizeDeps: { exclude: ["hidden-point-removal"] },
} satisfies UserConfig;
