/** One function of a WebAssembly module, with the bytes of its code. */
export interface WasmFunction {
  name: string;
  bytes: Uint8Array;
}

export interface WasmSections {
  functions: WasmFunction[];
  /** The names of what JavaScript can call. */
  exported: Set<string>;
  /** The constants that the module copies into its memory. */
  data: Uint8Array;
}

const CUSTOM = 0;
const IMPORT = 2;
const EXPORT = 7;
const CODE = 10;
const DATA = 11;
const FUNCTION_NAMES = 1;

/** Splits a module that has a name section into its functions and its data. */
export function sectionsOf(module: Uint8Array): WasmSections {
  const reader = new Reader(module);
  reader.skip(8);
  let imported = 0;
  let bodies: Uint8Array[] = [];
  let names = new Map<number, string>();
  let exported = new Set<string>();
  let data: Uint8Array = new Uint8Array();
  while (!reader.done) {
    const id = reader.number();
    const section = new Reader(reader.bytes());
    // All imports are functions: the glue imports no memory and no table.
    if (id === IMPORT) imported = section.number();
    else if (id === EXPORT) exported = new Set(section.list(() => exportedName(section)));
    else if (id === CODE) bodies = section.list(() => section.bytes());
    else if (id === DATA) data = section.rest();
    else if (id === CUSTOM && section.text() === "name") names = functionNames(section);
  }
  const functions = bodies.map((bytes, i) => ({ name: names.get(imported + i) ?? "", bytes }));
  return { functions, exported, data };
}

function exportedName(section: Reader): string {
  const name = section.text();
  section.skip(1);
  section.number();
  return name;
}

function functionNames(section: Reader): Map<number, string> {
  while (!section.done) {
    const kind = section.number();
    const part = new Reader(section.bytes());
    if (kind === FUNCTION_NAMES) return new Map(part.list(() => [part.number(), part.text()]));
  }
  return new Map();
}

/** Reads numbers, byte strings and lists as WebAssembly writes them. */
class Reader {
  readonly #bytes: Uint8Array;
  #at = 0;

  constructor(bytes: Uint8Array) {
    this.#bytes = bytes;
  }

  get done(): boolean {
    return this.#at >= this.#bytes.length;
  }

  skip(count: number): void {
    this.#at += count;
  }

  number(): number {
    let value = 0;
    for (let weight = 1; ; weight *= 128) {
      const byte = this.#bytes[this.#at++]!;
      value += (byte & 127) * weight;
      if (byte < 128) return value;
    }
  }

  bytes(): Uint8Array {
    const length = this.number();
    this.skip(length);
    return this.#bytes.subarray(this.#at - length, this.#at);
  }

  text(): string {
    return new TextDecoder().decode(this.bytes());
  }

  list<T>(item: () => T): T[] {
    return Array.from({ length: this.number() }, item);
  }

  rest(): Uint8Array {
    return this.#bytes.subarray(this.#at);
  }
}
