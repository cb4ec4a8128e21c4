import { compile, type InitInput, type WasmModule } from "./instance/compile.js";
import { compiledOnce, initFrom, startedModule } from "./instance/start.js";

// One literal expression: bundlers look for exactly this form. Others keep the address as it is, so
// this file stays beside the folder `wasm`.
const ownFile = compiledOnce(() => compile(new URL("./wasm/hpr_bg.wasm", import.meta.url)));

/**
 * Loads the wasm and starts it. Without an argument it is the file that comes
 * with the package. Does nothing where it is running already, and callers that
 * come with the same argument while it is starting get the same promise; with
 * another one they wait, and try theirs if the earlier one fails. After a failure
 * it may be called again; after a trap (`internal`) it starts a new instance.
 *
 * @throws HprError `load`, as a rejection, if it cannot be fetched, compiled or started.
 */
export function init(input?: InitInput): Promise<void> {
  return initFrom(ownFile, input);
}

/**
 * The compiled wasm for a worker: that of the instance that is running or
 * starting, else the package's own file.
 */
export async function moduleForWorker(): Promise<WasmModule> {
  return (await startedModule()) ?? (await ownFile());
}
