/** Whether Node's own modules can be imported (Deno and Bun have them too). */
export function hasNodeModules(): boolean {
  const { process } = globalThis as { process?: { versions?: { node?: string } } };
  return typeof process?.versions?.node === "string";
}

/**
 * A built-in module of Node. The name is a variable and the hints are there so
 * that bundlers for browsers, where this never runs, leave the import alone.
 */
export async function importNodeModule<Module>(name: `node:${string}`): Promise<Module> {
  return (await import(/* webpackIgnore: true */ /* @vite-ignore */ name)) as Module;
}
