import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";
import { samples } from "./build/samples-plugin.ts";
import { threeForLoaders } from "./build/three-for-loaders-plugin.ts";

const here = (path: string) => fileURLToPath(new URL(path, import.meta.url));

export default defineConfig({
  root: here("."),
  // Relative addresses: the page can be served from any folder of any site.
  base: "./",
  build: { outDir: here("dist"), emptyOutDir: true, target: "es2022", chunkSizeWarningLimit: 900 },
  plugins: [samples()],
  worker: { format: "es", plugins: () => [threeForLoaders()] },
  // Bundling three ahead of time would hide from the plugin above which loader asks for it.
  optimizeDeps: { exclude: ["three", "hidden-point-removal"] },
});
