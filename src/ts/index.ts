import type { InitInput } from "./instance/compile.js";
import { engine } from "./instance/own-engine.js";
import { initFrom } from "./instance/start.js";
import { ownWasm } from "./own-wasm.js";

export * from "./api.js";

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
  return initFrom(engine, ownWasm(), input);
}
