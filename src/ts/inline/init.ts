import type { InitInput } from "../instance/compile.js";
import { compiledOnce, initFrom } from "../instance/start.js";
import { compileEmbedded } from "./embedded.js";

const embedded = compiledOnce(compileEmbedded);

/**
 * Starts the wasm that is embedded in this entry: nothing is fetched, so it works
 * offline and where no .wasm file can be served. With an argument it is the same as
 * `init` of the main entry; both start the one instance that all entries share, so
 * that a `WorkerPointCloud` created afterwards needs no .wasm file either.
 *
 * @throws HprError `load`, as a rejection, if it cannot be compiled or started.
 */
export function init(input?: InitInput): Promise<void> {
  return initFrom(embedded, input);
}
