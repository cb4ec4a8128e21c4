import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";
import { bundledExamples, examples } from "./build/examples-plugin.ts";
import { COMMON } from "./build/page-plugins.ts";

const here = (path: string) => fileURLToPath(new URL(path, import.meta.url));

/** The pages of examples, in the folder examples of the demo page. */
export default defineConfig({
  ...COMMON,
  root: here("../examples"),
  publicDir: false,
  build: {
    outDir: here("dist/examples"),
    emptyOutDir: false,
    target: "es2022",
    chunkSizeWarningLimit: 2000,
    rolldownOptions: { input: bundledExamples },
  },
  plugins: [examples()],
});
