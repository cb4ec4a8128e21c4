import { loadError, type WasmModule } from "../instance/compile.js";
import { gzippedWasm } from "../wasm/embedded.js";

/** Compiles the wasm this entry carries, gzipped and written in base64. */
export async function compileEmbedded(): Promise<WasmModule> {
  try {
    // Not by fetching a data: address, which a page's security policy may forbid.
    const gzipped = Uint8Array.from(atob(gzippedWasm), (character) => character.charCodeAt(0));
    const stream = new Blob([gzipped]).stream().pipeThrough(new DecompressionStream("gzip"));
    return await WebAssembly.compile(await new Response(stream).arrayBuffer());
  } catch (cause) {
    throw loadError("the embedded wasm", cause);
  }
}
