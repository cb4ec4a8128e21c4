import { runnerImport } from "vite";

import { inRoot, root } from "./paths.js";

/**
 * Loads a TypeScript file of the repository that is not compiled with the scripts. Vite compiles it, because the page's
 * modules need Vite.
 */
export async function load<Module>(file: string): Promise<Module> {
  const settings = { root, configFile: false, logLevel: "warn" } as const;
  return (await runnerImport<Module>(inRoot(file), settings)).module;
}
