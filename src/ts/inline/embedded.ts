import { FULL, loadError, type WasmModule } from "../instance/compile.js";
import { gzippedWasm } from "../wasm/embedded.js";

/** Compiles the wasm of this entry, which is gzipped and written in base64. */
export async function compileEmbedded(): Promise<WasmModule> {
  try {
    // The bytes do not come from a data: address, because a page's security policy may forbid that.
    const gzipped = Uint8Array.from(atob(gzippedWasm), (character) => character.charCodeAt(0));
    const stream = new Blob([gzipped]).stream().pipeThrough(new DecompressionStream("gzip"));
    return await WebAssembly.compile(await new Response(stream).arrayBuffer());
  } catch (cause) {
    throw loadError("the embedded wasm", cause, FULL);
  }
}
