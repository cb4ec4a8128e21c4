import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";
import { COMMON, declarations } from "../build/page-plugins.ts";

const here = (path: string) => fileURLToPath(new URL(path, import.meta.url));
const NAME = "hidden-point-cloud";

/** Builds one module beside the page, with its types. The files that it loads later are in a folder with its name. */
export default defineConfig({
  ...COMMON,
  root: here(".."),
  publicDir: false,
  build: {
    outDir: here("../dist"),
    emptyOutDir: false,
    assetsDir: NAME,
    target: "es2022",
    modulePreload: false,
    chunkSizeWarningLimit: 900,
    rolldownOptions: {
      input: here(`${NAME}.ts`),
      preserveEntrySignatures: "strict",
      output: { entryFileNames: "[name].js" },
    },
  },
  plugins: [declarations(here("api.ts"), `${NAME}.d.ts`)],
});
