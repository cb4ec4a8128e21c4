import { compiledOnce, compileOwn, FULL, type InitInput, type WasmModule } from "./instance/compile.js";
import { configuredWasm } from "./instance/configure.js";
import { engine, state } from "./instance/instance.js";
import { initFrom, startedModule } from "./instance/start.js";

// This must be one literal expression: bundlers look for exactly this form. Other tools keep the
// address unchanged, so this file must stay beside the folder `wasm`.
const ownFile = compiledOnce(() => compileOwn(() => new URL("./wasm/hpr_bg.wasm", import.meta.url), FULL));

/**
 * Loads the wasm and starts it. Without an argument, it loads the file that comes with the package,
 * or what `configure` was given.
 * Does nothing if the wasm is running already. While it is starting, callers with the same argument
 * get the same promise. Callers with another argument wait, and try theirs if the earlier one
 * fails. It may be called again after a failure. After a trap (`internal`), it starts a new
 * instance.
 *
 * @throws HprError (as a rejection) `load` if it cannot be fetched, compiled or started.
 */
export function init(input?: InitInput): Promise<void> {
  return initFrom(engine, configuredWasm() ?? ownFile, input);
}

/**
 * The compiled wasm for a worker: from the instance that is running or starting, or else from the
 * package's own file.
 */
export async function moduleForWorker(): Promise<WasmModule> {
  return (await startedModule(state)) ?? (await (configuredWasm() ?? ownFile)());
}
