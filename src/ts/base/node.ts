/** Whether Node's own modules can be imported (Deno and Bun have them too). */
export function hasNodeModules(): boolean {
  const { process } = globalThis as { process?: { versions?: { node?: string } } };
  return typeof process?.versions?.node === "string";
}

/**
 * A built-in module of Node. Bundlers for browsers must leave this import alone, since it never
 * runs there. The variable for the name and the hints make them do so.
 */
export async function importNodeModule<Module>(name: `node:${string}`): Promise<Module> {
  return (await import(/* webpackIgnore: true */ /* @vite-ignore */ name)) as Module;
}
