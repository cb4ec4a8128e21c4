import type { InitInput } from "../instance/compile.js";
import { compiledOnce, initFrom } from "../instance/start.js";
import { compileEmbedded } from "./embedded.js";

const embedded = compiledOnce(compileEmbedded);

/**
 * Starts the wasm that is embedded in this entry. Nothing is fetched, so it works offline and on
 * servers that cannot serve a .wasm file. With an argument, it does the same as `init` of the main
 * entry. Both start the one instance that all entries share. So a `WorkerPointCloud` that is
 * created later needs no .wasm file either.
 *
 * @throws HprError (as a rejection) `load` if it cannot be compiled or started.
 */
export function init(input?: InitInput): Promise<void> {
  return initFrom(embedded, input);
}
