import { compiledOnce, compileOwn, FULL, type OwnWasm, type WasmModule } from "./instance/compile.js";
import { configuredWasm } from "./instance/configure.js";
import { state } from "./instance/instance.js";
import { startedModule } from "./instance/start.js";

// This must be one literal expression: bundlers look for exactly this form. Other tools keep the
// address unchanged, so this file must stay beside the folder `wasm`.
const ownFile = compiledOnce(() => compileOwn(() => new URL("./wasm/hpr_bg.wasm", import.meta.url), FULL));

/** What `configure` was given, or the file that comes with the package. */
export function ownWasm(): OwnWasm {
  return configuredWasm() ?? ownFile;
}

/**
 * The compiled wasm for a worker: from the instance that is running or starting, or else from the
 * package's own file.
 */
export async function moduleForWorker(): Promise<WasmModule> {
  return (await startedModule(state)) ?? (await ownWasm()());
}
