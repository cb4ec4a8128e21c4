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

/** The path of a file that this package exports, found from the working directory. */
export async function installedFile(name: string): Promise<string | undefined> {
  try {
    const { createRequire } = await importNodeModule<typeof import("node:module")>("node:module");
    return createRequire(`${nodeProcess()!.cwd()}/`).resolve(`hidden-point-removal/${name}`);
  } catch {
    return undefined;
  }
}
