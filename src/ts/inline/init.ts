import { compiledOnce, FULL, type InitInput, loadError, type WasmModule } from "../instance/compile.js";
import { configuredWasm, embed } from "../instance/configure.js";
import { engine } from "../instance/own-engine.js";
import { initFrom } from "../instance/start.js";
import { workerText } from "../wasm/embedded-worker.js";
import { gzippedWasm } from "../wasm/embedded.js";

/** Compiles the wasm of this entry, which is gzipped and written in base64. */
async function compileEmbedded(): Promise<WasmModule> {
  try {
    // The bytes do not come from a data: address, because a page's security policy may forbid that.
    const gzipped = Uint8Array.from(atob(gzippedWasm), (character) => character.charCodeAt(0));
    const stream = new Blob([gzipped]).stream().pipeThrough(new DecompressionStream("gzip"));
    return await WebAssembly.compile(await new Response(stream).arrayBuffer());
  } catch (cause) {
    throw loadError("the embedded wasm", cause, FULL);
  }
}

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
