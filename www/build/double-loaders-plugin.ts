import { fileURLToPath } from "node:url";
import type { Plugin } from "vite";

const DOUBLE = fileURLToPath(new URL("../loaders/three-double.ts", import.meta.url));

/** Lets three's loaders of untyped coordinates keep f64; see loaders/three-double.ts. */
export function doubleLoaders(): Plugin {
  return {
    name: "double-loaders",
    enforce: "pre",
    resolveId(source, importer) {
      return source === "three" && /loaders\/(PCD|XYZ|OBJ)Loader\.js/.test(importer ?? "") ? DOUBLE : null;
    },
  };
}
