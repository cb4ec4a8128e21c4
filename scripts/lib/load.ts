import { createServer, createServerModuleRunner } from "vite";

import { inRoot, root } from "./run.js";

/**
 * Loads a TypeScript file of the repository that is not compiled with the scripts. Vite compiles it, because the page's
 * modules need Vite. It stays open until the process ends: some modules import others when they first need them.
 */
export async function load<Module>(file: string): Promise<Module> {
  const server = await createServer({
    root,
    configFile: false,
    logLevel: "warn",
    appType: "custom",
    optimizeDeps: { noDiscovery: true },
    server: { middlewareMode: true, hmr: false, ws: false, watch: null },
  });
  const runner = createServerModuleRunner(server.environments.ssr, { hmr: false });
  return await runner.import(inRoot(file));
}
