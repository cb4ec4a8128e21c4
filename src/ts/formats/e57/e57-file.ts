import type { Place, Reading } from "../cloud-file.js";
import { FormatProblem } from "../problem.js";
import type { NumberType } from "../numbers.js";
import type { E57Wasm } from "./wasm.js";

/** A scan of a file, as its description says. */
export interface E57Scan {
  name: string;
  /** The number of its points. */
  count: number;
  columns: { name: string; type: NumberType }[];
  /** Where it stands, and whether this surely is the place of the scanner. */
  viewpoint: Place;
  isScanner: boolean;
  /** Whether single precision holds its positions. */
  isSingle: boolean;
}

/** What the functions of the wasm answer besides counts. */
const [MISSING, REFUSED] = [-1, -2];
/** So many bytes of the file are supplied at a time. */
const PART = 1 << 22;
/** The numbers about each scan. */
const FACTS = 5;
const TYPES: Readonly<Record<string, NumberType>> = {
  u1: "uint8", i1: "int8", u2: "uint16", i2: "int16", u4: "uint32", i4: "int32", f4: "float32", f8: "float64",
}; // prettier-ignore

/** A file in the memory of the wasm that reads it. With the file, the memory is given up. */
export class E57File {
  readonly #wasm: E57Wasm;
  readonly #source: Reading["source"];
  readonly #signal: Reading["signal"];

  /** In words: the coordinate reference system. */
  system = "";
  scans: E57Scan[] = [];

  private constructor(module: WebAssembly.Module, { source, signal }: Reading) {
    this.#wasm = new WebAssembly.Instance(module, {}).exports as unknown as E57Wasm;
    this.#source = source;
    this.#signal = signal;
    this.#wasm.begin(source.size);
  }

  static async open(module: WebAssembly.Module, reading: Reading): Promise<E57File> {
    const file = new E57File(module, reading);
    const count = await file.#run(() => file.#wasm.open());
    const [system = "", ...lines] = file.#text().split("\n");
    file.system = system;
    const facts = file.#numbers(FACTS * count);
    for (const line of lines) {
      const [kind = "", ...words] = line.split("\t");
      if (kind === "scan") {
        const [x, y, z, isScanner, isSingle] = facts.subarray(FACTS * file.scans.length) as unknown as Place & number[];
        file.scans.push({
          count: Number(words[0]),
          name: words[1] ?? "",
          columns: [],
          viewpoint: [x, y, z],
          isScanner: isScanner === 1,
          isSingle: isSingle === 1,
        });
      } else {
        file.scans.at(-1)!.columns.push({ type: TYPES[kind]!, name: words[0] ?? "" });
      }
    }
    return file;
  }

  /** The rows of a scan, some thousands at a time: x, y, z and the columns of one point after another. */
  async *rows(scan: number): AsyncGenerator<{ count: number; numbers: Float64Array }> {
    const width = 3 + this.scans[scan]!.columns.length;
    await this.#run(() => this.#wasm.begin_scan(scan));
    for (;;) {
      const count = await this.#run(() => this.#wasm.next_rows());
      if (count === 0) return;
      yield { count, numbers: this.#numbers(width * count) };
    }
  }

  /** Runs a step, and supplies the parts of the file that it needs. */
  async #run(step: () => number): Promise<number> {
    for (;;) {
      this.#signal?.throwIfAborted();
      let answer: number;
      try {
        answer = step();
      } catch (cause) {
        throw new FormatProblem("its E57 content is broken", { cause });
      }
      if (answer === REFUSED) throw new FormatProblem(this.#text());
      if (answer !== MISSING) return answer;
      await this.#supply(this.#wasm.missing());
    }
  }

  async #supply(from: number): Promise<void> {
    const bytes = await this.#source.read(from, Math.min(from + PART, this.#source.size));
    if (bytes.length === 0) throw new FormatProblem("it has become shorter while it was read");
    const place = this.#wasm.supply(from, bytes.length);
    new Uint8Array(this.#wasm.memory.buffer, place >>> 0, bytes.length).set(bytes);
  }

  #text(): string {
    const place = this.#wasm.text_at() >>> 0;
    return new TextDecoder().decode(new Uint8Array(this.#wasm.memory.buffer, place, this.#wasm.text_length()));
  }

  #numbers(count: number): Float64Array {
    return new Float64Array(this.#wasm.memory.buffer, this.#wasm.numbers_at() >>> 0, count);
  }
}
