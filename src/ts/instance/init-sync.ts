// A file of its own: its types name no engine, whose types Node lacks.
import type { SyncInitInput } from "./compile.js";
import { engine } from "./own-engine.js";
import { startSync } from "./start.js";

/**
 * Starts the wasm from its bytes or its compiled module, at once. Does nothing if it is running
 * already.
 *
 * @throws HprError `load` if it cannot be compiled or started.
 */
export function initSync(input: SyncInitInput): void {
  startSync(engine, input);
}
