import type { WasmModule } from "../instance/compile.js";
import { allocating } from "./builder.js";
import { FormatProblem } from "./problem.js";

/** What files.wasm offers, which is src/files. All functions take and return numbers. */
interface Functions {
  memory: { readonly buffer: ArrayBuffer };
  text_at(): number;
  text_length(): number;
  numbers_at(): number;

  /** Takes the size of an E57 file. */
  begin(size: number): void;
  /** The place for the bytes of a part of the file. */
  supply(from: number, length: number): number;
  /** The first byte that is missing. */
  missing(): number;
  /** The number of scans, or `MISSING` or `REFUSED`, as those below. */
  open(): number;
  begin_scan(index: number): number;
  /** The number of rows; 0 at the end of the scan. */
  next_rows(): number;

  /** The place for bytes of LAZ. */
  room(length: number): number;
  bytes_at(): number;
  /** 0 or `REFUSED`. */
  begin_laz(format: number, rowBytes: number, version: number): number;
  /** The number of chunks, or `REFUSED`. */
  chunk_table(hasPoints: boolean): number;
  /** The number of points, or `REFUSED`. */
  begin_chunk(points: number): number;
  /** The number of points; 0 after the last one. */
  next_points(): number;
}

/** What the functions of the wasm answer besides counts. */
export const [MISSING, REFUSED] = [-1, -2];

/** Compiles files.wasm, which reads E57 and LAZ. */
export type CompileFiles = () => Promise<WasmModule>;

export async function moduleOf({ wasm }: { wasm?: CompileFiles | undefined }): Promise<WasmModule> {
  if (wasm === undefined) throw new FormatProblem("the reader of E57 and LAZ is not here");
  return wasm();
}

/** The wasm that reads one file. With the file, its memory is given up. */
export class FilesWasm {
  readonly functions: Functions;

  constructor(module: WasmModule) {
    // wasm-bindgen would keep JavaScript's values in a table, and there are none.
    const glue = { "./hpr_bg.js": { __wbindgen_init_externref_table: () => undefined } };
    this.functions = new WebAssembly.Instance(module, glue).exports as unknown as Functions;
  }

  text(): string {
    return new TextDecoder().decode(this.bytes(this.functions.text_at(), this.functions.text_length()));
  }

  numbers(count: number): Float64Array<ArrayBuffer> {
    const place = this.functions.numbers_at() >>> 0;
    return new Float64Array(this.functions.memory.buffer, place, count);
  }

  bytes(place: number, length: number): Uint8Array<ArrayBuffer> {
    return new Uint8Array(this.functions.memory.buffer, place >>> 0, length);
  }

  /** Puts bytes where the next function looks for them. */
  put(bytes: Uint8Array): void {
    const place = allocating(bytes.length, () => this.functions.room(bytes.length));
    this.bytes(place, bytes.length).set(bytes);
  }

  /** The answer of a function, if the file is not refused. */
  answer(count: number): number {
    if (count === REFUSED) throw new FormatProblem(this.text());
    return count;
  }
}
