import { compiledOnce, type InitInput } from "../instance/compile.js";
import { configuredWasm, embed } from "../instance/configure.js";
import { engine } from "../instance/own-engine.js";
import { initFrom } from "../instance/start.js";
import { workerText } from "../wasm/embedded-worker.js";
import { compileEmbedded } from "./embedded.js";

const embedded = compiledOnce(compileEmbedded);

/**
 * Starts the wasm that is embedded in this entry. Nothing is fetched, so it works offline and on
 * servers that cannot serve a .wasm file. With an argument, it does the same as `init` of the main
 * entry. Both start the one instance that all entries share. A `WorkerPointCloud` that is
 * created later needs no other file either: its worker starts from a blob, or, if the page's security policy
 * forbids that, from its file.
 *
 * @throws HprError (as a rejection) `load` if it cannot be compiled or started.
 */
export function init(input?: InitInput): Promise<void> {
  useEmbedded();
  return initFrom(engine, configuredWasm() ?? embedded, input);
}

/** All entries, and workers, use the embedded wasm and script. */
export function useEmbedded(): void {
  embed(embedded, workerText);
}
