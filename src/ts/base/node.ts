interface NodeProcess {
  versions?: { node?: string };
  cwd(): string;
  getBuiltinModule?: (name: string) => unknown;
}

/** Node's `process`. A bundler that sees the bare name may add a package of that name (Parcel installs it). */
function nodeProcess(): NodeProcess | undefined {
  return (globalThis as { process?: NodeProcess }).process;
}

/** Whether Node's own modules can be imported (Deno and Bun have them too). */
export function hasNodeModules(): boolean {
  return typeof nodeProcess()?.versions?.node === "string";
}

/**
 * A built-in module of Node. Bundlers for browsers must leave the import alone, since it never
 * runs there. The variable for the name and the hints make them do so.
 */
export async function importNodeModule<Module>(name: `node:${string}`): Promise<Module> {
  // No bundler and no test runner changes this call. Node has it since 20.16.
  const module = nodeProcess()?.getBuiltinModule?.(name);
  return (module ??
    (await import(/* webpackIgnore: true */ /* turbopackIgnore: true */ /* @vite-ignore */ name))) as Module;
}

/**
 * The path of a file that this package exports, found from the module that asks, or else from the working
 * directory. The module is inside a bundle if a bundler moved it, and a bundler may have changed its address.
 */
export async function installedFile(name: string, asking: string | undefined): Promise<string | undefined> {
  const { createRequire } = await importNodeModule<typeof import("node:module")>("node:module");
  for (const place of [asking, `${nodeProcess()!.cwd()}/`]) {
    try {
      if (place !== undefined) return createRequire(place).resolve(`hidden-point-removal/${name}`);
    } catch {
      // It is not there, or the place is no file.
    }
  }
  return undefined;
}
