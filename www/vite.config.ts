import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";
import { ahead, COMMON, html, policy } from "./build/page-plugins.ts";
import { docs } from "./build/docs-plugin.ts";
import { underExamples } from "./build/examples-plugin.ts";
import { samples } from "./build/samples-plugin.ts";

const here = (path: string) => fileURLToPath(new URL(path, import.meta.url));

export default defineConfig({
  ...COMMON,
  root: here("."),
  build: { outDir: here("dist"), emptyOutDir: true, target: "es2022", chunkSizeWarningLimit: 900 },
  plugins: [samples(), html(), ahead(), policy(), docs(), underExamples(here("examples.vite.config.ts"))],
});
