import type { WasmModule } from "../instance/compile.js";
import { CloudBuilder } from "./builder.js";
import { type CloudFile, type Place, type Reading, SCAN, scanColumns } from "./cloud-file.js";
import type { Column, NumberType } from "./numbers.js";
import { Contradictions, FormatProblem } from "./problem.js";
import { crsOf } from "./las/crs.js";
import { FilesWasm, MISSING, moduleOf } from "./wasm.js";

/** E57: all scans, one after another, in the coordinates of the file. Colors are bytes. */
export async function readE57(reading: Reading): Promise<CloudFile> {
  const found = new Contradictions(reading.damaged);
  const file = await E57File.open(await moduleOf(reading), reading);
  const { scans } = file;
  const total = scans.reduce((sum, { count }) => sum + count, 0);
  if (total === 0) throw new FormatProblem("it has no points");

  const names = scans.map(({ name }, i) => name || `scan ${i + 1}`);
  const columns = columnsOf(scans);
  const precision = scans.every(({ isSingle }) => isSingle) ? "float32" : "float64";
  const builder = new CloudBuilder(precision, [SCAN, ...columns], reading, total);
  for (const [number, scan] of scans.entries()) {
    const places = columns.map(({ name }) => scan.columns.findIndex((column) => column.name === name));
    const width = 3 + scan.columns.length;
    try {
      for await (const { count, numbers } of file.rows(number)) {
        for (let row = 0; row < count; row++) {
          if (!builder.takes()) continue;
          const at = row * width;
          const i = builder.put(numbers[at]!, numbers[at + 1]!, numbers[at + 2]!);
          builder.values[0]![i] = number;
          for (let k = 0; k < places.length; k++) {
            builder.values[1 + k]![i] = places[k]! < 0 ? NaN : numbers[at + 3 + places[k]!]!;
          }
        }
        reading.onProgress?.(Math.min(1, builder.rows / total));
      }
    } catch (cause) {
      if (!(cause instanceof FormatProblem)) throw cause;
      found.add(scans.length > 1 ? `${names[number]!}: ${cause.message}` : cause.message);
    }
  }
  if (builder.rows === 0) throw new FormatProblem(found.notes.join("; "));
  const crs = crsOf({ wkt: file.system });
  const cloud = builder.finish();
  // Clouds that were put together have a place, too: the origin of their coordinates.
  const areScanners = scans.some(({ isScanner }) => isScanner);
  return {
    ...cloud,
    columns: scanColumns(cloud.columns, names),
    isGrid: true,
    notes: [...found.notes, ...cloud.notes],
    up: "z",
    ...(crs && { crs }),
    unit: { name: "m", meters: 1 },
    ...(areScanners && { stations: scans.map(({ viewpoint }, i) => ({ name: names[i]!, viewpoint })) }),
  };
}

/** The columns of all scans. If a scan lacks one, its numbers are NaN there. */
function columnsOf(scans: readonly E57Scan[]): Column[] {
  const names = [...new Set(scans.flatMap(({ columns }) => columns.map(({ name }) => name)))];
  return names.map((name) => {
    const types = scans.map(({ columns }) => columns.find((column) => column.name === name)?.type);
    const [type] = types;
    return { name, type: type !== undefined && types.every((other) => other === type) ? type : "float64" };
  });
}

/** A scan of a file, as its description says. */
interface E57Scan {
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

/** So many bytes of the file are supplied at a time. */
const PART = 1 << 22;
/** The numbers about each scan. */
const FACTS = 5;
const TYPES: Readonly<Record<string, NumberType>> = {
  u1: "uint8", i1: "int8", u2: "uint16", i2: "int16", u4: "uint32", i4: "int32", f4: "float32", f8: "float64",
}; // prettier-ignore

/** A file in the memory of the wasm that reads it. With the file, the memory is given up. */
class E57File {
  readonly #wasm: FilesWasm;
  readonly #source: Reading["source"];
  readonly #signal: Reading["signal"];

  /** In words: the coordinate reference system. */
  system = "";
  scans: E57Scan[] = [];

  private constructor(module: WasmModule, { source, signal }: Reading) {
    this.#wasm = new FilesWasm(module);
    this.#source = source;
    this.#signal = signal;
    this.#wasm.functions.begin(source.size);
  }

  static async open(module: WasmModule, reading: Reading): Promise<E57File> {
    const file = new E57File(module, reading);
    const count = await file.#run(() => file.#wasm.functions.open());
    const [system = "", ...lines] = file.#wasm.text().split("\n");
    file.system = system;
    const facts = file.#wasm.numbers(FACTS * count);
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
    await this.#run(() => this.#wasm.functions.begin_scan(scan));
    for (;;) {
      const count = await this.#run(() => this.#wasm.functions.next_rows());
      if (count === 0) return;
      yield { count, numbers: this.#wasm.numbers(width * count) };
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
      if (answer !== MISSING) return this.#wasm.answer(answer);
      await this.#supply(this.#wasm.functions.missing());
    }
  }

  async #supply(from: number): Promise<void> {
    const bytes = await this.#source.read(from, Math.min(from + PART, this.#source.size));
    if (bytes.length === 0) throw new FormatProblem("it has become shorter while it was read");
    const place = this.#wasm.functions.supply(from, bytes.length);
    this.#wasm.bytes(place, bytes.length).set(bytes);
  }
}
