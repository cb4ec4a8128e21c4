import { HEADER, Reader, SECTION } from "../../scripts/lib/wasm-reader";
import { wasmBytes } from "./support";

/** The package's wasm, but its memory cannot grow beyond this many pages of 64 KiB. */
export function cappedWasm(pages: number): Uint8Array<ArrayBuffer> {
  const wasm = wasmBytes();
  const reader = new Reader(wasm.subarray(HEADER));
  while (!reader.done) {
    const start = wasm.length - reader.rest().length;
    const section = reader.number();
    const content = new Reader(reader.bytes());
    if (section !== SECTION.memory) continue;
    const [memories, hasMost, least] = [content.number(), content.number(), content.number()];
    if (memories !== 1 || hasMost !== 0) throw new Error("The wasm has not one memory without a limit.");
    const limited = [1, 1, ...number(least), ...number(pages)];
    const memory = Uint8Array.of(SECTION.memory, limited.length, ...limited);
    return new Uint8Array(Buffer.concat([wasm.subarray(0, start), memory, reader.rest()]));
  }
  throw new Error("The wasm has no memory.");
}

/** A number below 2 ** 14, as WebAssembly writes it. */
function number(value: number): [number, number] {
  return [(value & 127) | 128, value >> 7];
}
