import type { UserConfig } from "vite";

/** Options of Vite that the page and the element share. */
export const COMMON = {
  // Relative addresses: both can be served from any folder of any site.
  base: "./",
  // This is the decoder's build for workers. The copc package would import another build.
  resolve: { alias: [{ find: /^laz-perf$/, replacement: "laz-perf/lib/worker/index.js" }] },
  worker: { format: "es" },
  // The library finds its worker and its wasm beside its own files.
  optimizeDeps: { exclude: ["hidden-point-removal"] },
} satisfies UserConfig;
