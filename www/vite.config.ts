import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";
import { ahead } from "./build/ahead-plugin.ts";
import { COMMON } from "./build/common.ts";
import { html } from "./build/html-plugin.ts";
import { policy } from "./build/policy-plugin.ts";
import { samples } from "./build/samples-plugin.ts";

const here = (path: string) => fileURLToPath(new URL(path, import.meta.url));

export default defineConfig({
  ...COMMON,
  root: here("."),
  build: { outDir: here("dist"), emptyOutDir: true, target: "es2022", chunkSizeWarningLimit: 900 },
  plugins: [samples(), html(), ahead(), policy()],
});
