import { fileURLToPath } from "node:url";
import type { Plugin } from "vite";

const REPLACEMENT = fileURLToPath(new URL("../loaders/three-for-loaders.ts", import.meta.url));

/** Gives three's point cloud loaders the module they find in loaders/three-for-loaders.ts for "three". */
export function threeForLoaders(): Plugin {
  return {
    name: "three-for-loaders",
    enforce: "pre",
    resolveId(source, importer) {
      return source === "three" && /loaders\/(PLY|PCD|XYZ|OBJ)Loader\.js/.test(importer ?? "") ? REPLACEMENT : null;
    },
  };
}
