import {
  bytesOf,
  compile,
  type InitInput,
  isModule,
  loadError,
  nameOf,
  type SyncInitInput,
  type WasmModule,
} from "./compile.js";
import { imports, runningInstance, startInstance } from "./instance.js";

/** The source for `init()` without an argument: the file beside the package, or the embedded wasm. */
export type OwnWasm = () => Promise<WasmModule>;

let starting: { input: InitInput | undefined; done: Promise<void> } | undefined;

/** The `init()` of every entry, with that entry's own wasm. */
export function initFrom(own: OwnWasm, input: InitInput | undefined): Promise<void> {
  if (runningInstance() !== undefined) {
    return Promise.resolve();
  }
  if (starting !== undefined && starting.input === input) {
    return starting.done;
  }
  const started = starting === undefined ? start(own, input) : starting.done.catch(() => start(own, input));
  const attempt = {
    input,
    done: started.finally(() => {
      if (starting === attempt) {
        starting = undefined;
      }
    }),
  };
  starting = attempt;
  return attempt.done;
}

/**
 * Starts the wasm from its bytes or its compiled module, at once. Does nothing if it is running
 * already.
 *
 * @throws HprError `load` if it cannot be compiled or started.
 */
export function initSync(input: SyncInitInput): void {
  if (runningInstance() !== undefined) {
    return;
  }
  try {
    const module = isModule(input) ? input : new WebAssembly.Module(bytesOf(input));
    startInstance(module, new WebAssembly.Instance(module, imports));
  } catch (cause) {
    throw loadError("the given wasm", cause);
  }
}

/** The compiled wasm of the instance that is running or starting, if any. */
export async function startedModule(): Promise<WasmModule | undefined> {
  await starting?.done;
  return runningInstance()?.module;
}

async function start(own: OwnWasm, input: InitInput | undefined): Promise<void> {
  const module = await (input === undefined ? own() : compile(input));
  try {
    const instance = await WebAssembly.instantiate(module, imports);
    // initSync() may have been called in the meantime.
    if (runningInstance() === undefined) {
      startInstance(module, instance);
    }
  } catch (cause) {
    throw loadError(input === undefined ? "the package's own wasm" : nameOf(input), cause);
  }
}

/** Compiles once, and keeps the module for workers and for a start after a trap. A failure is not kept. */
export function compiledOnce(load: OwnWasm): OwnWasm {
  let module: Promise<WasmModule> | undefined;
  return () => {
    module ??= load().catch((error: unknown) => {
      module = undefined;
      throw error;
    });
    return module;
  };
}
