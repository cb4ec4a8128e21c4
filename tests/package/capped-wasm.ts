import { wasmBytes } from "./support";

const MEMORY = 5;

/** The package's wasm, but its memory cannot grow beyond this many pages of 64 KiB (128 to 16,383). */
export function cappedWasm(pages: number): Uint8Array<ArrayBuffer> {
  const wasm = wasmBytes();
  // Behind the magic number and the version come the sections: a number, a length, the content.
  for (let start = 8; start < wasm.length;) {
    const [length, content] = number(wasm, start + 1);
    const end = content + length;
    if (wasm[start] === MEMORY) {
      // The count of memories, whether there is a limit, the pages at the start.
      const [memories, limited, ...least] = wasm.subarray(content, end);
      if (memories !== 1 || limited !== 0) throw new Error("The wasm has not one memory without a limit.");
      const capped = [1, 1, ...least, (pages & 127) | 128, pages >> 7];
      return new Uint8Array(
        Buffer.concat([wasm.subarray(0, start), Uint8Array.of(MEMORY, capped.length, ...capped), wasm.subarray(end)]),
      );
    }
    start = end;
  }
  throw new Error("The wasm has no memory.");
}

/** A number as WebAssembly writes it, 7 bits in each byte, and where it ends. */
function number(bytes: Uint8Array, at: number): [number, number] {
  let value = 0;
  for (let shift = 0; ; shift += 7) {
    const byte = bytes[at++]!;
    value |= (byte & 127) << shift;
    if (byte < 128) return [value, at];
  }
}
